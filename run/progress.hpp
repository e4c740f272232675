#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <string>
#include <utility>

#include "run/statistics.hpp"

namespace drape {

/// Progress of one stage of a run. Written by the working thread, read by the displaying one.
struct Progress {
  std::atomic<const char*> stage = "";  ///< a verb such as "simulating", "drawing"; a string literal
  std::atomic<const char*> unit = "";   ///< "steps", "frames"
  std::atomic<std::int64_t> done = 0;
  std::atomic<std::int64_t> total = 0;

  void begin(const char* what, const char* of, std::int64_t count) {
    done = 0;
    total = count;
    unit = of;
    stage = what;
  }
};

/// Progress and costs of a run so far.
struct Pace {
  std::int64_t steps = 0;  ///< steps done
  std::int64_t left = 0;   ///< steps still to do
  double seconds = 0;      ///< time since the first step began [s]
  double simulated = 0;    ///< part of `seconds` spent in steps [s]
  double iterations = 0;   ///< sum over all steps
  double substeps = 0;     ///< sum over all steps
  bool drawn = false;      ///< the run also draws

  /// Returns the predicted time of the whole run, from the mean so far [s].
  [[nodiscard]] double whole() const {
    return seconds + seconds / static_cast<double>(steps) * static_cast<double>(left);
  }
};

/// Returns the main cost of a run and a remedy: "300 steps will take about 37 s: each takes 700 iterations; faster
/// would be …".
std::string describe_pace(const Pace& pace, const SimulationSettings& settings);

/// Observer that reports once, as early as possible, that a run will take long.
class SlowRunWarning final : public StepObserver {
 public:
  struct Limits {
    double after = 5;      ///< the pace is trusted after this time [s]
    double long_run = 30;  ///< runs longer than this are reported [s]
  };

  /// @param steps of the whole run
  /// @param drawn true if the run also draws
  /// @param tell  called from the simulating thread
  SlowRunWarning(std::int64_t steps, bool drawn, std::function<void(const std::string&)> tell)
      : SlowRunWarning(steps, drawn, std::move(tell), Limits{}) {}
  SlowRunWarning(std::int64_t steps, bool drawn, std::function<void(const std::string&)> tell, const Limits& limits)
      : steps_(steps), tell_(std::move(tell)), limits_(limits), next_look_(limits.after) {
    pace_.drawn = drawn;
  }

  void begin(const Simulation& simulation) override;
  void after_step(const Simulation& simulation, const StepReport& report, double seconds) override;

 private:
  using Clock = std::chrono::steady_clock;

  std::int64_t steps_;
  std::function<void(const std::string&)> tell_;
  Limits limits_;
  double next_look_;
  bool told_ = false;
  Pace pace_;
  Clock::time_point begin_;
};

}  // namespace drape
