#include "sweep/estimate.hpp"

#include "run/outputs.hpp"

namespace drape {
namespace {

// Of the size of what the scenes of scenes/homework take; what effects take is not in it.
constexpr double explicit_spring = 4e-9, iterated_spring = 80e-9, newton_spring = 400e-9;  // [s] a step
constexpr double step = 2e-6, run = 3e-3;                                                  // [s] whatever the scene
constexpr double pixel = 60e-9, film = 0.15;  // [s], of drawing and encoding one, and of beginning

double of_a_spring(Method method) {
  if (is_explicit(method)) return explicit_spring;
  return method == Method::implicit ? newton_spring : iterated_spring;
}

}  // namespace

double estimated_cost(const Scene& scene, const RunOptions& options) {
  const auto steps = static_cast<double>(options.steps.value_or(scene.step_count()));
  const SimulationSettings& s = scene.simulation;
  const double substeps = s.accuracy ? 8 : 1;
  const double stages = is_explicit(s.integrator.method) || s.integrator.scheme == TimeScheme::backward_euler ? 1 : 2;
  const auto springs = static_cast<double>(s.cloth.springs.size());
  double seconds = run + steps * substeps * stages * (step + springs * of_a_spring(s.integrator.method));
  if (needs_drawing(options)) {
    const double pixels = static_cast<double>(scene.video.size.x()) * scene.video.size.y();
    seconds += film + film_extent(scene, options).frames.count() * pixels * pixel;
  }
  return seconds;
}

}  // namespace drape
