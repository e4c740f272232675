#include "check/chained_motion.hpp"

#include "run/run_steps.hpp"

namespace drape {

void run_chained(Simulation& simulation, std::span<const std::int64_t> starts, const RoundingUnits& quanta,
                 std::span<StepObserver* const> observers, const std::stop_token& stop) {
  for (const std::int64_t end : starts.subspan(1)) {
    run_steps(simulation, end, observers, stop);
    if (stop.stop_requested()) return;
    const RoundingUnits next = end == starts.back() ? quanta.at_end() : quanta;
    simulation.restore(rounded(simulation.state(), simulation.cloth().pins, next));
  }
  for (StepObserver* observer : observers) observer->begin(simulation);
}

}  // namespace drape
