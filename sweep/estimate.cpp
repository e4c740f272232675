#include "sweep/estimate.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include "run/outputs.hpp"

namespace drape {
namespace {

// Of the size of what the scenes of scenes/ take.
constexpr double explicit_spring = 1.5e-9, iterated_spring = 35e-9, newton_spring = 200e-9;  // [s] a step
constexpr double step = 0.5e-6, run = 3e-3;                                                  // [s] whatever the scene
constexpr double pixel = 60e-9, film = 0.15;  // [s], of drawing and encoding one, and of beginning

/// What an effect takes, with the iterations that a step has more where there is it [s], a vertex and step.
struct EffectCost {
  std::string_view effect;
  double evaluated;  ///< where forces are evaluated once
  double solved;     ///< where a step is solved for
};
constexpr std::array<EffectCost, 9> effect_costs{{{"wind", 10e-9, 10e-9},
                                                  {"field", 0.1e-6, 0.3e-6},
                                                  {"air", 0.1e-6, 0.25e-6},
                                                  {"bending", 20e-9, 50e-9},
                                                  {"sphere", 20e-9, 0.1e-6},
                                                  {"ground", 20e-9, 1e-6},
                                                  {"strain_limit", 6e-6, 6e-6},
                                                  {"body", 1.5e-6, 3.5e-6},
                                                  {"self_collision", 4e-6, 4e-6}}};

double of_a_spring(Method method) {
  if (is_explicit(method)) return explicit_spring;
  return method == Method::implicit ? newton_spring : iterated_spring;
}

/// Of all effects together; those that are not in the list take nothing to speak of.
double of_a_vertex(const SimulationSettings& settings) {
  double seconds = 0;
  for (const Effect& effect : settings.effects) {
    const auto* const found = std::ranges::find(effect_costs, effect.name(), &EffectCost::effect);
    if (found == effect_costs.end()) continue;
    seconds += is_explicit(settings.integrator.method) ? found->evaluated : found->solved;
  }
  return seconds;
}

}  // namespace

double estimated_cost(const Scene& scene, const RunOptions& options) {
  const auto steps = static_cast<double>(options.steps.value_or(scene.step_count()));
  const SimulationSettings& s = scene.simulation;
  const double substeps = s.accuracy ? 8 : 1;
  const double stages = is_explicit(s.integrator.method) || s.integrator.scheme == TimeScheme::backward_euler ? 1 : 2;
  const auto springs = static_cast<double>(s.cloth.springs.size());
  const auto vertices = static_cast<double>(s.cloth.vertex_count());
  double seconds =
      run + steps * substeps * stages * (step + springs * of_a_spring(s.integrator.method) + vertices * of_a_vertex(s));
  if (needs_drawing(options)) {
    const double pixels = static_cast<double>(scene.video.size.x()) * scene.video.size.y();
    seconds += film + film_extent(scene, options).frames.count() * pixels * pixel;
  }
  return seconds;
}

}  // namespace drape
