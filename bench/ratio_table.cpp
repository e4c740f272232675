#include "bench/ratio_table.hpp"

#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <Eigen/Core>
#include <algorithm>
#include <ctime>
#include <memory>
#include <utility>

namespace drape {

void register_subject(const std::string& name, const std::string& who, int expected, std::function<Subject()> make) {
  // All repetitions share the subject.
  const auto subject = std::make_shared<Subject>();
  const auto measure = [expected, make = std::move(make), subject](benchmark::State& state) {
    if (!subject->run) *subject = make();
    subject->restore();
    subject->run();  // fills the caches again after the previous benchmark
    for (auto _ : state) {
      subject->restore();
      const std::clock_t start = std::clock();
      const int done = subject->run();
      const double elapsed = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
      state.SetIterationTime(elapsed / done);
      if (done != expected) state.SkipWithError("it did not do all of its work");
    }
  };
  benchmark::RegisterBenchmark((name + "/" + who).c_str(), measure)
      ->UseManualTime()
      ->Unit(benchmark::kMicrosecond)
      ->Iterations(1);
}

namespace {

double median(std::vector<double> samples) {
  std::sort(samples.begin(), samples.end());
  const std::size_t middle = samples.size() / 2;
  return samples.size() % 2 == 1 ? samples[middle] : (samples[middle - 1] + samples[middle]) / 2;
}

/// Formats a median with half the interquartile range, which a single disturbed sample does not change.
std::string time_cell(std::vector<double> samples) {
  if (samples.empty()) return "–";
  std::sort(samples.begin(), samples.end());
  const std::size_t quarter = samples.size() / 4;
  const double middle = median(samples);
  const double spread = (samples[samples.size() - 1 - quarter] - samples[quarter]) / 2;
  const auto [scale, unit] = middle < 1e3   ? std::pair{1.0, "µs"}
                             : middle < 1e6 ? std::pair{1e-3, "ms"}
                                            : std::pair{1e-6, "s"};
  return fmt::format("{:.3g} {} ±{:.0f}%", middle * scale, unit, 100 * spread / middle);
}

}  // namespace

bool RatioReporter::ReportContext(const Context& context) {
  PrintBasicContext(&GetErrorStream(), context);
  return true;
}

void RatioReporter::ReportRuns(const std::vector<Run>& runs) {
  for (const Run& run : runs) {
    if (run.run_type != Run::RT_Iteration) continue;
    const std::string& name = run.run_name.function_name;
    if (run.error_occurred) {
      GetErrorStream() << name << ": " << run.error_message << '\n';
      continue;
    }
    const std::size_t slash = name.rfind('/');
    samples_[name.substr(0, slash)][name.substr(slash + 1)].push_back(run.GetAdjustedRealTime());
  }
}

void RatioReporter::print(const RatioTable& table) {
  const auto measured = [&](const std::string& name) { return samples_.contains(name); };
  if (std::none_of(table.cases.begin(), table.cases.end(), measured)) return;
  std::ostream& out = GetOutputStream();
  out << fmt::format("| case | {0} | {1} | {0} ÷ {1} |\n|---|---|---|---|\n", table.first, table.second);
  for (const std::string& name : table.cases) {
    if (!measured(name)) continue;
    const Samples& first = samples_[name][table.first];
    const Samples& second = samples_[name][table.second];
    const std::string ratio =
        first.empty() || second.empty() ? "–" : fmt::format("{:.3f}", median(first) / median(second));
    out << fmt::format("| {} | {} | {} | {} |\n", name, time_cell(first), time_cell(second), ratio);
  }
  out << '\n';
}

void RatioReporter::Finalize() {
  std::ostream& out = GetOutputStream();
  for (const RatioTable& table : tables_) print(table);
  out << fmt::format(
      "Medians of CPU time ± half the interquartile range of repetitions in random order, in one process. {} logical "
      "CPUs "
      "at {:.2f} GHz; compiler {}; Eigen {}.{}.{}.\n",
      benchmark::CPUInfo::Get().num_cpus, benchmark::CPUInfo::Get().cycles_per_second / 1e9, __VERSION__,
      EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION);
}

}  // namespace drape
