#include "run/resources.hpp"

#include <algorithm>

#include "core/machine.hpp"
#include "drape/sim/schemes/method_choice.hpp"
#include "run/outputs.hpp"
#include "sim/parallel/loops.hpp"

namespace drape {
namespace {

/// Minimum for one thread: two threads share the smallest cloth that is divided.
constexpr int vertices_of_a_thread = worth_dividing / 2;

}  // namespace

SimulationSettings with_threads(SimulationSettings settings, int asked, bool drawn) {
  settings.threads = asked;
  if (asked > 0) return settings;
  const int gain = std::min(settings.cloth.vertex_count() / vertices_of_a_thread, most_automatic_threads);
  settings.threads = std::clamp(processors_left() - (drawn ? 1 : 0), 1, std::max(1, gain));
  settings.spare_threads = true;
  return settings;
}

namespace {

// Rough coefficients, measured with the scenes in scenes/.
constexpr double newton_per_iterated = 6;     // cost of a step relative to iterative methods
constexpr double run = 3e-3;                  // fixed cost of a run [s]
constexpr double usual_stiffness = 10;        // assumed substeps of an explicit step; only a run knows the number
constexpr double pixel = 60e-9, film = 0.15;  // drawing and encoding of a pixel, and start of a film [s]

}  // namespace

double estimated_cost(const Scene& scene, const RunOptions& options) {
  const auto steps = static_cast<double>(options.steps.value_or(scene.step_count()));
  const SimulationSettings& s = scene.simulation;
  const double substeps = s.accuracy ? 8 : 1;
  const double stages = is_explicit(s.integrator.method) ? 1 : traits_of(s.integrator.scheme).stages;
  const Method method = s.integrator.method;
  const double each =
      estimated_step(s, method, s.integrator.substep_count(), usual_stiffness) + estimated_contact(s, method);
  double seconds = run + steps * substeps * stages * each * (method == Method::implicit ? newton_per_iterated : 1);
  if (needs_drawing(options)) {
    const double pixels = static_cast<double>(scene.video.size.x()) * scene.video.size.y();
    seconds += film + film_extent(scene, options).frames.count() * pixels * pixel;
  }
  return seconds;
}

}  // namespace drape
