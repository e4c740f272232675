#include "drape/sim/effects/moving_pins.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>

#include "core/keys.hpp"
#include "drape/sim/settings.hpp"
#include "sim/effects/effect_keys.hpp"
#include "sim/mesh_anchors.hpp"
#include "sim/system.hpp"

namespace drape {
namespace {

constexpr double largest_jump = 1e-6;  // [m]
constexpr double most_steps = 1e15;

}  // namespace

void MovingPins::describe(Keys& keys) {
  keys.add("pins", VertexSelection{&pins}, "", "The pins to move. Each must be among those of [cloth].")
      .must_be_given();
  keys.add("keyframes",
           KeyframeList{{"offset", "position"},
                        &keyframes,
                        [this](std::size_t i) { path = static_cast<Path>(i); },
                        static_cast<std::size_t>(path)},
           "s, m",
           "Positions over time: the displacement from their start, or the position of their centroid. The pins start "
           "at their place in the cloth at 0 s and stay at the last keyframe.");
  keys.add(
      "rotations", KeyframeList{{"rotate"}, &turns}, "s, degrees",
      "Angles over time about the fixed x axis, then y, then z, around the pins' centroid, which `keyframes` moves. "
      "They start at 0 and are interpolated one by one: 720 is two turns.");
  keys.add(
      "follow", &follow, "",
      "A mesh that they hold on to instead, `\"body/{frame:04}.obj\"` or `{ file, prim }`: each pin keeps its place "
      "beside the nearest triangle at the start.");
  keys.choice("interpolation", interpolation, {"linear", "smooth"},
              "Interpolation between keyframes and between rotations: at constant speed, or with continuous velocity.");
  keys.add("release", &release, "s",
           "Time at which they are released, with the velocity they have then. Default: never.")
      .at_least(0);
  keys.add("cloth", ClothName{&cloth}, "", "The name of the cloth that has these pins. Needed if there are several.");
}

void MovingPins::check(const SimulationSettings& settings, const ProblemSink& problem) const {
  check_cloth(cloth, settings, problem);
  const Cloth& all = settings.cloth;
  for (const int vertex : pins) {
    if (std::ranges::binary_search(all.pins, vertex)) continue;
    problem("pins", fmt::format("vertex {} is not pinned; add it to [cloth] pins", vertex));
    break;
  }
  if (pins.empty()) problem("pins", "expected at least one");
  if (keyframes.empty() && turns.empty() && !follow && !release) {
    problem("", "give 'keyframes', 'rotations', 'follow' or 'release'; with none of them, nothing happens");
  }
  if (follow && !(keyframes.empty() && turns.empty())) {
    problem("follow", "the mesh already says how they move: omit 'keyframes' and 'rotations'");
  }
  if (!turns.empty() && turns.front().time == 0 && !turns.front().value.isZero(0)) {
    problem("rotations", "the pins start at their place in the cloth: give a rotation at 0 s a later time");
  }
  if (follow && !pins.empty()) {
    try {
      static_cast<void>(motion(all));
      if (follow->samples.empty() && !release) {
        problem("follow",
                "the mesh does not move, so the pins would stay where they are, as they do without this table");
      }
    } catch (const std::invalid_argument& error) {
      problem("follow", error.what());
    }
  }
  for (const Effect& other : settings.effects) {
    const auto* moving = other.as<MovingPins>();
    if (moving == this) break;
    if (moving != nullptr) check_overlap(*moving, problem);
  }
  if (pins.empty() || keyframes.empty() || keyframes.front().time > 0) return;
  const double jump = (keyframes.front().value - start(all)).norm();
  if (jump > largest_jump) {
    problem("keyframes", fmt::format("the pins start at their place in the cloth, and the keyframe at 0 s is {:.3g} m "
                                     "away from it: give it a later time",
                                     jump));
  }
}

void MovingPins::check_overlap(const MovingPins& other, const ProblemSink& problem) const {
  for (const int vertex : pins) {
    if (!std::ranges::binary_search(other.pins, vertex)) continue;
    problem("pins", fmt::format("vertex {} is in two tables [effects.moving_pins]: only one can move it", vertex));
    return;
  }
}

void MovingPins::install(System& system) const {
  // Once they are released, the system's cloth does not have them as pins.
  const bool held =
      std::ranges::all_of(pins, [&](int vertex) { return std::ranges::binary_search(system.cloth.pins, vertex); });
  if (!held) return;
  if (!keyframes.empty() || !turns.empty() || follow) system.pin_motions.push_back(motion(system.cloth));
  if (release) {
    // First step that begins at the release or later; the factor allows for rounding of its start time.
    const double step = std::ceil(*release / system.whole_step * (1 - 1e-12));
    if (step < most_steps) system.pin_releases.push_back({static_cast<std::int64_t>(step), pins});
  }
}

Eigen::Vector3d MovingPins::middle(const Cloth& all) const {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const int vertex : pins) sum += all.positions.row(vertex).transpose();
  return sum / static_cast<double>(pins.size());
}

Eigen::Vector3d MovingPins::start(const Cloth& all) const {
  return path == Path::offset ? Eigen::Vector3d::Zero() : middle(all);
}

PinMotion MovingPins::motion(const Cloth& all) const {
  PinMotion motion{.vertices = pins, .base = all.positions(pins, Eigen::all)};
  if (follow) {
    motion.anchors = std::make_shared<MeshAnchors>(*follow, motion.base, 0);
    return motion;
  }
  const bool to_places = path == Path::position && !keyframes.empty();
  const Eigen::Vector3d from = to_places ? middle(all) : Eigen::Vector3d::Zero();
  motion.path = Keyframes(starting_at(keyframes, from), interpolation);
  if (to_places) motion.base.rowwise() -= middle(all).transpose();
  if (turns.empty()) return motion;
  motion.turn = Keyframes(starting_at(turns, Eigen::Vector3d::Zero()), interpolation);
  motion.middle = to_places ? Eigen::Vector3d::Zero() : middle(all);
  return motion;
}

}  // namespace drape
