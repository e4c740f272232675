#include "study/measure.hpp"

#include <sched.h>
#include <time.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>

#include "sim/flipped_pairs.hpp"
#include "sim/simulation.hpp"

namespace drape {
namespace {

constexpr std::int64_t turns = 24;  // that a run of a case is cut into

/// Keeps the calling thread on the processor where it is, until the object's end.
class Pinned {
 public:
  Pinned() {
    CPU_ZERO(&before_);
    known_ = sched_getaffinity(0, sizeof before_, &before_) == 0;
    cpu_set_t here;
    CPU_ZERO(&here);
    CPU_SET(static_cast<unsigned>(std::max(0, sched_getcpu())), &here);
    if (known_) sched_setaffinity(0, sizeof here, &here);
  }
  Pinned(const Pinned&) = delete;
  Pinned& operator=(const Pinned&) = delete;
  ~Pinned() {
    if (known_) sched_setaffinity(0, sizeof before_, &before_);
  }

 private:
  cpu_set_t before_;
  bool known_ = false;
};

/// Seconds that this thread has computed: the time in which others had the processor does not count.
double thread_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// One run of one case, in turns.
class CaseRun {
 public:
  CaseRun(const Scene& scene, Measured& measured, bool observe)
      : simulation_(scene.simulation),
        pairs_(scene.simulation.cloth.triangles),
        measured_(measured),
        observe_(observe) {}

  void turn() {
    const std::int64_t steps = measured_.what.steps;
    const std::int64_t end = std::min(steps, simulation_.state().step + (steps + turns - 1) / turns);
    while (simulation_.state().step < end) {
      const double begin = thread_seconds();
      const StepReport report = simulation_.step();
      seconds_ += thread_seconds() - begin;
      if (observe_) observe(report);
    }
  }

  void finish() {
    const auto steps = static_cast<double>(measured_.what.steps);
    if (observe_) {
      measured_.flipped_pairs /= steps;
    } else {
      measured_.microseconds.push_back(1e6 * seconds_ / steps);
    }
  }

 private:
  void observe(const StepReport& report) {
    const State& state = simulation_.state();
    const Eigen::VectorXd& m = simulation_.cloth().masses;
    measured_.iterations.push_back(report.iterations);
    measured_.capped += report.converged ? 0 : 1;
    measured_.height.push_back(m.dot(state.x.col(2)) / m.sum());
    measured_.flipped_pairs += pairs_.count(state.x);
  }

  Simulation simulation_;
  FlippedPairs pairs_;
  Measured& measured_;
  bool observe_;
  double seconds_ = 0;
};

}  // namespace

Quartiles quartiles(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const auto at = [&](double fraction) {
    const double place = fraction * static_cast<double>(values.size() - 1);
    const auto below = static_cast<std::size_t>(place);
    const std::size_t above = std::min(below + 1, values.size() - 1);
    return std::lerp(values[below], values[above], place - static_cast<double>(below));
  };
  return {at(0.25), at(0.5), at(0.75)};
}

double Measured::mean_iterations() const { return mean_iterations(0, iterations.size()); }

double Measured::mean_iterations(std::size_t first, std::size_t last) const {
  const auto from = iterations.begin() + static_cast<std::ptrdiff_t>(first);
  const auto to = iterations.begin() + static_cast<std::ptrdiff_t>(last);
  return static_cast<double>(std::accumulate(from, to, std::int64_t{0})) / static_cast<double>(last - first);
}

std::vector<Measured> measure(const std::vector<StudyCase>& cases, int runs, const std::stop_token& stop,
                              Progress& progress) {
  const Pinned pinned;
  std::vector<Scene> scenes;
  std::vector<Measured> results;
  for (const StudyCase& one : cases) {
    scenes.push_back(one.load());
    results.emplace_back().what = one;
    results.back().step = scenes.back().simulation.step;
  }
  progress.begin("measuring", "turns", (runs + 1) * turns);
  for (int run = 0; run <= runs; ++run) {
    std::vector<std::unique_ptr<CaseRun>> running;
    for (std::size_t i = 0; i < cases.size(); ++i) {
      running.push_back(std::make_unique<CaseRun>(scenes[i], results[i], run == 0));
    }
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

}  // namespace drape
