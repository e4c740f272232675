#include "run/run_steps.hpp"

#include <chrono>

namespace drape {

void run_steps(Simulation& simulation, std::int64_t steps, std::span<StepObserver* const> observers,
               const std::stop_token& stop) {
  using Clock = std::chrono::steady_clock;
  for (StepObserver* observer : observers) observer->begin(simulation);
  while (simulation.state().step < steps && !stop.stop_requested()) {
    const auto begin = Clock::now();
    const StepReport report = simulation.step();
    const double seconds = std::chrono::duration<double>(Clock::now() - begin).count();
    for (StepObserver* observer : observers) observer->after_step(simulation, report, seconds);
  }
}

}  // namespace drape
