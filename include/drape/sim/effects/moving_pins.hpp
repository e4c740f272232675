#pragma once

// Example:
//   const drape::Keyframe up{.time = 1, .value = {0, 0, 1}};
//   drape::Effects effects{drape::MovingPins{.pins = {0, 1}, .keyframes = {up}, .release = 2}};

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "drape/sim/body_shape.hpp"
#include "drape/sim/effects/effect.hpp"
#include "drape/sim/tracks.hpp"

namespace drape {

struct Cloth;
struct PinMotion;

/// Pins that move together on keyframes or with a mesh, are released, or both. They start at their position in the
/// cloth at 0 s and stay at the last keyframe.
struct MovingPins {
  static constexpr std::string_view name = "moving_pins";
  static constexpr bool repeatable = true;

  /// Meaning of a keyframe's value [m].
  enum class Path : std::size_t {
    offset,   ///< displacement from the start
    position  ///< position of the pins' centroid
  };

  std::vector<int> pins = {};            ///< ascending, without duplicates, all pinned in the cloth
  std::vector<Keyframe> keyframes = {};  ///< at ascending times from 0 s on; one at 0 s is the start
  Path path = Path::offset;
  Interpolation interpolation = Interpolation::linear;
  std::optional<double> release = {};  ///< time of release, at the current velocity [s]; default: never
  std::vector<Keyframe> turns = {};    ///< angles about the fixed x axis, then y, then z, around the centroid [degrees]
  std::shared_ptr<const MeshMotion> follow = {};  ///< mesh that the pins follow instead, see MeshAnchors
  std::string cloth = {};                         ///< name of the pins' cloth; empty: the only one

  void describe(Keys& keys);
  void check(const SimulationSettings& settings, const ProblemSink& problem) const;
  void install(System& system) const;

 private:
  /// Returns the value of a keyframe at 0 s.
  [[nodiscard]] Eigen::Vector3d start(const Cloth& all) const;
  /// Returns the centroid of the pins in the cloth.
  [[nodiscard]] Eigen::Vector3d middle(const Cloth& all) const;
  [[nodiscard]] PinMotion motion(const Cloth& all) const;
  void check_overlap(const MovingPins& other, const ProblemSink& problem) const;
};

}  // namespace drape
