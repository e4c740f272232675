#include "study/measure.hpp"

#include <fmt/format.h>
#include <time.h>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>
#include <optional>
#include <utility>

#include "drape/sim/mesh.hpp"
#include "run/run_scene.hpp"

namespace drape {
namespace {

using Clock = std::chrono::steady_clock;

// Kernels are plain functions, so the times are global: one clock at a time.
std::array<double, kernel_part_count> part_seconds;
const Kernels* original = nullptr;

/// A stopwatch that adds its lifetime to the time of a part.
struct Stopwatch {
  std::size_t part;
  Clock::time_point begin = Clock::now();
  ~Stopwatch() { part_seconds[part] += std::chrono::duration<double>(Clock::now() - begin).count(); }
};

/// A kernel of the same type that calls and times the original.
template <auto Member, KernelPart Part>
struct Timed;
template <class Result, class... Arguments, Result (*Kernels::*Member)(Arguments...), KernelPart Part>
struct Timed<Member, Part> {
  static Result call(Arguments... arguments) {
    const Stopwatch watch{static_cast<std::size_t>(Part)};
    return (original->*Member)(arguments...);
  }
};

template <auto Member, KernelPart Part>
void wrap(Kernels& kernels) {
  kernels.*Member = &Timed<Member, Part>::call;
}

Kernels timed_version(const Kernels& plain) {
  Kernels k = plain;
  wrap<&Kernels::add_list_gradient, KernelPart::local>(k);
  wrap<&Kernels::add_list_value_gradient, KernelPart::local>(k);
  wrap<&Kernels::add_band_value_gradient, KernelPart::local>(k);
  wrap<&Kernels::evaluate_bands, KernelPart::local>(k);
  wrap<&Kernels::kick_bands, KernelPart::local>(k);
  wrap<&Kernels::band_blocks, KernelPart::assembly>(k);
  wrap<&Kernels::list_blocks, KernelPart::assembly>(k);
  wrap<&Kernels::add_band_product, KernelPart::product>(k);
  wrap<&Kernels::add_list_product, KernelPart::product>(k);
  wrap<&Kernels::add_scaled, KernelPart::vectors>(k);
  wrap<&Kernels::add_multiple, KernelPart::vectors>(k);
  wrap<&Kernels::drift, KernelPart::vectors>(k);
  wrap<&Kernels::dots, KernelPart::vectors>(k);
  wrap<&Kernels::add_multiples, KernelPart::vectors>(k);
  wrap<&Kernels::pack_single, KernelPart::global>(k);
  wrap<&Kernels::pack_double, KernelPart::global>(k);
  wrap<&Kernels::unpack_single, KernelPart::global>(k);
  wrap<&Kernels::unpack_double, KernelPart::global>(k);
  wrap<&Kernels::subtract_packed_single, KernelPart::global>(k);
  wrap<&Kernels::subtract_packed_double, KernelPart::global>(k);
  wrap<&Kernels::solve_single, KernelPart::global>(k);
  wrap<&Kernels::solve_double, KernelPart::global>(k);
  return k;
}

}  // namespace

KernelClock::KernelClock() : timed_(timed_version(kernels())), plain_(replace_kernels(timed_)) {
  original = &plain_;
  reset();
}

KernelClock::~KernelClock() { replace_kernels(plain_); }

void KernelClock::reset() { part_seconds.fill(0); }

double KernelClock::seconds(KernelPart part) const { return part_seconds[static_cast<std::size_t>(part)]; }

namespace {

constexpr double confidence = 0.95, narrow_share = 0.05;

}  // namespace

bool MedianInterval::known() const { return std::isfinite(lower) && std::isfinite(upper); }

bool MedianInterval::narrow() const {
  return known() && median - lower <= narrow_share * median && upper - median <= narrow_share * median;
}

std::size_t first_order_statistic(std::size_t n) {
  // Sum P(B = 0), P(B ≤ 1), … until both tails together exceed 1 − confidence.
  double one = std::exp2(-static_cast<double>(n)), below = one;
  std::size_t l = 0;
  while (2 * below <= 1 - confidence) {
    ++l;
    one *= static_cast<double>(n - l + 1) / static_cast<double>(l);
    below += one;
  }
  return l;
}

MedianInterval median_interval(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size(), half = n / 2;
  MedianInterval interval;
  interval.count = n;
  interval.median = n % 2 == 1 ? values[half] : std::midpoint(values[half - 1], values[half]);
  const std::size_t l = first_order_statistic(n);
  interval.lower = l > 0 ? values[l - 1] : std::numeric_limits<double>::quiet_NaN();
  interval.upper = l > 0 ? values[n - l] : std::numeric_limits<double>::quiet_NaN();
  return interval;
}

bool is_enough(const std::vector<double>& values, RunCount runs) {
  if (values.size() >= static_cast<std::size_t>(runs_at_most(runs))) return true;
  return !runs && values.size() >= fewest_for_interval && median_interval(values).narrow();
}

std::string runs_option(RunCount runs) { return runs ? fmt::format(" --runs {}", *runs) : std::string(); }

std::string describe_runs(RunCount runs) {
  if (!runs) {
    return fmt::format(
        "the median of as many runs as it takes until its interval of 95 % confidence, which is from one run to "
        "another "
        "(order statistics), is within 5 % of it, but no more than {}",
        most_runs);
  }
  return fmt::format("the median of {} run{}{}", *runs, *runs == 1 ? "" : "s",
                     *runs < static_cast<int>(fewest_for_interval)
                         ? ", which are too few for an interval"
                         : " and its interval of 95 % confidence, which is from one run to another (order statistics)");
}

namespace {

constexpr std::int64_t turns = 24;  // turns per run of a case

/// One run of one case, in turns.
class CaseRun {
 public:
  /// @param watch called after every step; a watched run is untimed
  CaseRun(const Scene& scene, Measured& measured, std::function<void(const Simulation&, const StepReport&)> watch)
      : pairs_(scene.simulation.cloth.triangles), measured_(measured), watch_(std::move(watch)) {
    const double begin = thread_seconds();
    simulation_.emplace(scene.simulation);
    if (!watch_) measured_.setup.push_back(1e6 * (thread_seconds() - begin));
  }

  void turn() {
    if (given_up_) return;
    const std::int64_t steps = step_count();
    const std::int64_t end = std::min(steps, simulation_->state().step + (steps + turns - 1) / turns);
    if (watch_) return watched_turn(end);
    const double begin = thread_seconds();
    run_steps(*simulation_, end, {});
    seconds_ += thread_seconds() - begin;
  }

  void finish() {
    if (watch_) {
      measured_.flipped_pairs /= static_cast<double>(std::max<std::int64_t>(1, simulation_->state().step));
    } else {
      measured_.microseconds.push_back(1e6 * seconds_ / static_cast<double>(step_count()));
    }
  }

 private:
  [[nodiscard]] std::int64_t step_count() const {
    return watch_ ? std::max(measured_.study_case.steps, measured_.study_case.watched_steps)
                  : measured_.study_case.steps;
  }

  void watched_turn(std::int64_t end) {
    const std::optional<double>& patience = measured_.study_case.patience;
    try {
      while (simulation_->state().step < end) {
        const double begin = thread_seconds();
        const StepReport report = simulation_->step();
        seconds_ += thread_seconds() - begin;
        observe(report);
        if (patience && seconds_ > *patience) return give_up(fmt::format("it takes more than {:g} s", *patience));
      }
    } catch (const DivergedError& error) {
      if (!patience) throw;
      give_up(error.what());
    }
  }

  /// Ends the run. It is a failure only before study_case.steps; later steps are just watched.
  void give_up(const std::string& why) {
    given_up_ = true;
    if (simulation_->state().step < measured_.study_case.steps) measured_.failure = why;
  }

  void observe(const StepReport& report) {
    const State& state = simulation_->state();
    const Eigen::VectorXd& m = simulation_->cloth().masses;
    measured_.iterations.push_back(report.iterations);
    if (state.step <= measured_.study_case.steps) measured_.capped += report.converged ? 0 : 1;
    measured_.height.push_back(m.dot(state.x.col(2)) / m.sum());
    measured_.flipped_pairs += pairs_.count(state.x);
    watch_(*simulation_, report);
  }

  std::optional<Simulation> simulation_;
  FlippedPairs pairs_;
  Measured& measured_;
  std::function<void(const Simulation&, const StepReport&)> watch_;
  double seconds_ = 0;
  bool given_up_ = false;
};

}  // namespace

PinnedThread::PinnedThread() {
  CPU_ZERO(&before_);
  known_ = sched_getaffinity(0, sizeof before_, &before_) == 0;
  cpu_set_t here;
  CPU_ZERO(&here);
  CPU_SET(static_cast<unsigned>(std::max(0, sched_getcpu())), &here);
  if (known_) sched_setaffinity(0, sizeof here, &here);
}

PinnedThread::~PinnedThread() {
  if (known_) sched_setaffinity(0, sizeof before_, &before_);
}

double thread_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double Measured::mean_iterations() const {
  return mean_iterations(0, std::min(iterations.size(), static_cast<std::size_t>(study_case.steps)));
}

double Measured::mean_iterations(std::size_t first, std::size_t last) const {
  const auto from = iterations.begin() + static_cast<std::ptrdiff_t>(first);
  const auto to = iterations.begin() + static_cast<std::ptrdiff_t>(last);
  return static_cast<double>(std::accumulate(from, to, std::int64_t{0})) / static_cast<double>(last - first);
}

std::vector<Measured> measure(const std::vector<StudyCase>& cases, RunCount runs, const std::stop_token& stop,
                              Progress& progress, const CaseWatch& watch) {
  const PinnedThread pinned;
  std::vector<Scene> scenes;
  std::vector<Measured> results;
  for (const StudyCase& one : cases) {
    scenes.push_back(one.load());
    results.emplace_back().study_case = one;
    results.back().step = scenes.back().simulation.step;
  }
  progress.begin("measuring", "turns", (runs_at_most(runs) + 1) * turns);
  for (int run = 0; run <= runs_at_most(runs); ++run) {
    std::vector<std::unique_ptr<CaseRun>> running;
    for (std::size_t i = 0; i < cases.size(); ++i) {
      if (!results[i].failure.empty() || is_enough(results[i].microseconds, runs)) continue;
      std::function<void(const Simulation&, const StepReport&)> first;
      if (run == 0) {
        first = [&watch, i](const Simulation& simulation, const StepReport& report) {
          if (watch) watch(i, simulation, report);
        };
      }
      running.push_back(std::make_unique<CaseRun>(scenes[i], results[i], std::move(first)));
    }
    if (running.empty()) break;
    for (std::int64_t turn = 0; turn < turns; ++turn) {
      for (const auto& one : running) {
        if (stop.stop_requested()) return {};
        one->turn();
      }
      ++progress.done;
    }
    for (const auto& one : running) one->finish();
  }
  return results;
}

std::string describe_measuring(RunCount runs) {
  return fmt::format(
      "Times are CPU times of one thread pinned to one core, averaged over the steps of a run: {}. The cases take "
      "turns in "
      "each run. A first run is not timed.",
      describe_runs(runs));
}

}  // namespace drape
