#include "study/stability_motions.hpp"

#include <fmt/format.h>

#include "core/error.hpp"
#include "study/stability.hpp"

namespace drape {
namespace {

constexpr double stiffness = 100;  // stiffness of the springs [N/m]
constexpr double below = 0.95, beyond = 1.2;
constexpr int steps = 99;       // few enough to make every state a frame
constexpr double far_away = 3;  // in cloth sizes

StudyMotion limit_motion(double factor) {
  const double safe = stability_limit(Method::semi_implicit, StabilityAxis::springs, stiffness);
  Scene scene;
  scene.name = "stability";
  scene.simulation = stability_cloth(Method::semi_implicit, StabilityAxis::springs, factor * safe, stiffness);
  scene.look.mesh_lines = true;
  const Vertices& at_first = scene.simulation.cloth.positions;
  const double size = (at_first.colwise().maxCoeff() - at_first.colwise().minCoeff()).norm();
  StudyMotionRecorder recorder(scene);
  Simulation simulation(scene.simulation);
  recorder.add(simulation);
  try {
    for (int step = 0; step < steps; ++step) {
      simulation.step();
      recorder.add(simulation);
      if (!((simulation.state().x - at_first).cwiseAbs().maxCoeff() < far_away * size)) break;
    }
  } catch (const DivergedError&) {
    if (simulation.state().x.allFinite()) recorder.add(simulation);  // the last finite state
  }
  return {fmt::format("semi-implicit, {} of the safe step", factor), {}, recorder.finish()};
}

}  // namespace

std::vector<StudyMotion> limit_motions() { return {limit_motion(below), limit_motion(beyond)}; }

std::string describe_limit_motions() {
  return fmt::format(
      "Two motions of that cloth with springs of {:g} N/m, by semi-implicit Euler: with {:g} of the safe step it "
      "swings, with {:g} of it the fastest oscillation grows in every step until the motion blows up.",
      stiffness, below, beyond);
}

}  // namespace drape
