#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <stop_token>
#include <vector>

#include "motion/checkpoint.hpp"
#include "run/progress.hpp"
#include "run/step_observer.hpp"

namespace drape {

/// Returns a Stop for a simulation that a stop request may end within a step.
Stop make_stop(const std::stop_token& stop);

/// Advances a simulation to step number `steps` and calls the observers in order. Returns early when a stop is
/// requested. A simulation with a Stop ends within the step, in the state before it.
/// @param from the checkpoint to resume from, if any
/// @throws DivergedError after the observers saw the last finite step
void run_steps(Simulation& simulation, std::int64_t steps, std::span<StepObserver* const> observers,
               const std::stop_token& stop, const ResumePoint* from = nullptr);

/// Advances likewise, with one function as the observer.
void run_steps(Simulation& simulation, std::int64_t steps, const std::stop_token& stop,
               const std::function<void(const StepReport&)>& after_step = {});

/// Checks that a checkpoint has every part that the simulation would have saved.
/// @throws UsageError if parts are missing
void require_whole(const ResumePoint& from, const Simulation& simulation);

/// Continues a state in a new simulation to step number `steps`. Ends early if that diverges.
void run_on(const SimulationSettings& settings, const State& state, std::int64_t steps,
            const std::vector<StepObserver*>& observers, const std::stop_token& stop);

/// Observer that shows the number of steps done.
class StepCounter final : public StepObserver {
 public:
  explicit StepCounter(Progress& progress) : progress_(progress) {}
  void after_step(const Simulation& simulation, const StepReport& report, double seconds) override;

 private:
  Progress& progress_;
};

}  // namespace drape
