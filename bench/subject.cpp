#include "bench/subject.hpp"

#include <benchmark/benchmark.h>

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

}  // namespace drape
