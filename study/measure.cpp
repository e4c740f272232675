#include "study/measure.hpp"

#include <fmt/format.h>
#include <time.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <optional>
#include <utility>

#include "run/run_steps.hpp"
#include "sim/flipped_pairs.hpp"

namespace drape {
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
    return watch_ ? std::max(measured_.what.steps, measured_.what.watched_steps) : measured_.what.steps;
  }

  void watched_turn(std::int64_t end) {
    const std::optional<double>& patience = measured_.what.patience;
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

  /// Ends the run. It is a failure only before what.steps; later steps are just watched.
  void give_up(const std::string& why) {
    given_up_ = true;
    if (simulation_->state().step < measured_.what.steps) measured_.failure = why;
  }

  void observe(const StepReport& report) {
    const State& state = simulation_->state();
    const Eigen::VectorXd& m = simulation_->cloth().masses;
    measured_.iterations.push_back(report.iterations);
    if (state.step <= measured_.what.steps) measured_.capped += report.converged ? 0 : 1;
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
  return mean_iterations(0, std::min(iterations.size(), static_cast<std::size_t>(what.steps)));
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
    results.emplace_back().what = one;
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
