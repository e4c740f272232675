#include "study/step_reference.hpp"

#include <array>

#include "run/run_steps.hpp"
#include "study/reference.hpp"

namespace drape {

std::optional<StepReference> extrapolate_step(SimulationSettings settings, double time, std::int64_t steps,
                                              const std::stop_token& stop, Progress& progress) {
  const std::int64_t half = steps / 2;
  settings.integrator.scheme = TimeScheme::sdirk2;
  settings.step = time / static_cast<double>(half);
  const auto coarse = run_reference(settings, half, {half}, stop, progress);
  if (!coarse) return std::nullopt;
  settings.step = time / static_cast<double>(steps);
  Simulation fine(to_rounding(settings, Method::implicit));
  progress.begin("computing the reference in small steps", "steps", steps);
  StepCounter counter(progress);
  run_steps(fine, steps, std::array<StepObserver*, 1>{&counter}, stop);
  if (stop.stop_requested()) return std::nullopt;
  StepReference reference;
  reference.x = (4 * fine.state().x - coarse->states.front().x) / 3;
  reference.step = settings.step;
  reference.gained = distance(fine.state().x, reference.x).max;
  reference.apart = coarse->apart_after(half);
  return reference;
}

}  // namespace drape
