#include "scene/quality.hpp"

#include <algorithm>

#include "sim/cloth.hpp"

namespace drape {
namespace {

using Given = std::function<bool(const char*)>;

void make_draft(Scene& scene, const Given& given) {
  constexpr int smallest = 16;    // as [video] size
  constexpr double rate = 12.5;   // [1/s]
  constexpr double coarser = 10;  // of a tolerance
  constexpr double coarse = 1e-4, fall = 0.03, gravity = 9.8;
  if (!given("video.size")) scene.video.size = (scene.video.size / 2).cwiseMax(smallest);
  if (!given("video.fps")) scene.video.fps = std::min(scene.video.fps, rate);
  if (!given("look.samples")) scene.look.samples = 1;
  if (!given("look.ambient_occlusion")) scene.look.ambient_occlusion = false;
  IntegratorSettings& integrator = scene.simulation.integrator;
  const bool solves = !is_explicit(integrator.method) && !scene.simulation.accuracy;
  if (!solves || given("integrator.tolerance")) return;
  if (integrator.tolerance) {
    *integrator.tolerance *= coarser;
  } else if (!integrator.stop && scene.simulation.cloth.vertex_count() > 0) {
    integrator.stop = StoppingRule::error;
    const double h = scene.simulation.step;
    integrator.tolerance = std::min(coarse * size_of(scene.simulation.cloth), fall * h * h * gravity);
  }
}

void make_print(Scene& scene, const Given& given) {
  constexpr int largest = 8192;  // as [video] size
  constexpr int samples = 4, anisotropy = 16;
  if (!given("video.size")) scene.video.size = (scene.video.size * 2).cwiseMin(largest);
  if (!given("look.samples")) scene.look.samples = samples;
  if (!given("look.anisotropy")) scene.look.anisotropy = anisotropy;
}

}  // namespace

void apply_quality(Scene& scene, const std::function<bool(const char*)>& given) {
  if (scene.quality == Quality::draft) make_draft(scene, given);
  if (scene.quality == Quality::print) make_print(scene, given);
}

}  // namespace drape
