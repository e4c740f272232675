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

/// For a simulation that is to end within a step, too.
Stop heeding(const std::stop_token& stop);

/// Advances a simulation until it has done that many steps in all, telling the observers, in their order. Returns early
/// when a stop is requested: within a step, if the simulation heeds it, and then as if that step had not begun.
/// @param from where the simulation goes on from, if it does
/// @throws DivergedError after the observers saw the last finite step
void run_steps(Simulation& simulation, std::int64_t steps, std::span<StepObserver* const> observers,
               const std::stop_token& stop, const Resumption* from = nullptr);

/// The same, telling one function.
void run_steps(Simulation& simulation, std::int64_t steps, const std::stop_token& stop,
               const std::function<void(const StepReport&)>& after_step = {});

/// Makes sure that a checkpoint has all that the simulation would have kept.
/// @throws UsageError if parts of it are missing
void require_whole(const Resumption& from, const Simulation& simulation);

/// Goes on from a state, in a simulation of its own, until so many steps are done in all. Ends where that diverges.
void run_on(const SimulationSettings& settings, const State& state, std::int64_t steps,
            const std::vector<StepObserver*>& observers, const std::stop_token& stop);

/// Shows how many steps are done.
class StepCounter final : public StepObserver {
 public:
  explicit StepCounter(Progress& progress) : progress_(progress) {}
  void after_step(const Simulation& simulation, const StepReport& report, double seconds) override;

 private:
  Progress& progress_;
};

}  // namespace drape
