#pragma once

// Example:
//   const drape::Keyframe up{.time = 1, .value = {0, 0, 1}};
//   drape::Effects effects{drape::MovingPins{.pins = {0, 1}, .keyframes = {up}, .release = 2}};

#include <memory>
#include <optional>
#include <vector>

#include "sim/effects/effect.hpp"
#include "sim/keyframes.hpp"
#include "sim/mesh_motion.hpp"

namespace drape {

struct Cloth;
struct PinMotion;

/// Moves pins together on keyframes or with a mesh, lets them go, or both. They start from where the cloth has them at
/// 0 s, and stay at the last keyframe.
struct MovingPins {
  static constexpr std::string_view name = "moving_pins";
  static constexpr bool repeatable = true;

  /// What the value of a keyframe is [m].
  enum class Path : std::size_t {
    offset,   ///< how far they are from where they start
    position  ///< where the middle of all of them is
  };

  std::vector<int> pins = {};            ///< ascending, each once, and among the cloth's
  std::vector<Keyframe> keyframes = {};  ///< at increasing times from 0 s on; one at 0 s is where they start
  Path path = Path::offset;
  Interpolation interpolation = Interpolation::linear;
  std::optional<double> release = {};  ///< when they are let go, with the speed that they have [s]; without it never
  std::vector<Keyframe> turns = {};    ///< angles about the fixed x axis, then y, then z, around their middle [degrees]
  std::shared_ptr<const MeshMotion> follow = {};  ///< a mesh that they hold on to instead, see MeshAnchors

  void describe(Keys& keys);
  void check(const SimulationSettings& settings, const ProblemSink& problem) const;
  void install(System& system) const;

 private:
  /// The value that a keyframe at 0 s has.
  [[nodiscard]] Eigen::Vector3d start(const Cloth& cloth) const;
  /// The centroid of the pins in the cloth.
  [[nodiscard]] Eigen::Vector3d middle(const Cloth& cloth) const;
  [[nodiscard]] PinMotion motion(const Cloth& cloth) const;
  void check_overlap(const MovingPins& other, const ProblemSink& problem) const;
};

}  // namespace drape
