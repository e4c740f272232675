#include "study/step_reference.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "run/run_steps.hpp"
#include "study/reference.hpp"

namespace drape {

std::optional<std::size_t> StepReference::place(std::int64_t moment) const {
  const auto found = std::ranges::lower_bound(moments, moment);
  if (found == moments.end() || *found != moment) return std::nullopt;
  return static_cast<std::size_t>(found - moments.begin());
}

double StepReference::gained(std::size_t place) const { return distance(plain[place], x[place]).max; }

std::optional<StepReference> extrapolate_steps(SimulationSettings settings, std::vector<std::int64_t> moments,
                                               std::int64_t parts, const std::stop_token& stop, Progress& progress) {
  StepReference reference;
  reference.moments = std::move(moments);
  const double whole = settings.step;
  const std::int64_t half = parts / 2;
  std::vector<std::int64_t> keep;
  for (const std::int64_t moment : reference.moments) keep.push_back(moment * half);
  settings.integrator.scheme = TimeScheme::sdirk2;
  settings.accuracy.reset();
  settings.step = whole / static_cast<double>(half);
  const auto coarse = run_reference(settings, keep.back(), keep, stop, progress);
  if (!coarse) return std::nullopt;
  reference.step = settings.step = whole / static_cast<double>(parts);
  Simulation fine(to_rounding(settings, Method::implicit));
  progress.begin("computing the reference in small steps", "steps", parts * reference.moments.back());
  for (std::size_t i = 0; i < keep.size(); ++i) {
    StepCounter counter(progress);
    run_steps(fine, 2 * keep[i], std::array<StepObserver*, 1>{&counter}, stop);
    if (stop.stop_requested()) return std::nullopt;
    reference.plain.push_back(fine.state().x);
    reference.x.emplace_back((4 * fine.state().x - coarse->states[i].x) / 3);
  }
  reference.apart = coarse->apart_after(keep.front());
  return reference;
}

}  // namespace drape
