#pragma once

// Example:
//   drape::Effects effects{drape::Body{.box = Eigen::Vector3d(0.6, 0.6, 0.2), .center = Eigen::Vector3d(0, 0, -0.5)}};
//   drape::MeshMotion pyramid{.mesh = drape::make_box({0.2, 0.2, 0.2})};
//   effects.add(drape::Body{.mesh = std::make_shared<drape::MeshMotion>(pyramid), .thickness = 0.005});

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "drape/sim/body_shape.hpp"
#include "drape/sim/effects/effect.hpp"
#include "drape/sim/tracks.hpp"

namespace drape {

class MovingBody;
/// A triangle mesh that the cloth collides with. It lets nothing through, even at large moves in a step, see
/// BodyContacts. A closed mesh is solid; an open one is a shell with two equal sides. The body rests at `center`, or
/// moves in one of three ways: straight on, on an orbit with which it turns, or on keyframes. It may also turn around
/// its position and change its shape.
struct Body {
  static constexpr std::string_view name = "body";
  static constexpr EffectCost cost{.evaluated = 0.3e-6, .solved = 2.0e-6};
  static constexpr bool touches = true;
  static constexpr bool repeatable = true;

  std::optional<Eigen::Vector3d> box = {};      ///< sides of a box around `center`, all above 0 [m]
  std::shared_ptr<const MeshMotion> mesh = {};  ///< any other shape, around its own origin [m]
  std::string prim = {};                        ///< name of the mesh within its file, used by the file's reader
  std::optional<Eigen::Vector3d> center = {};   ///< position of the shape's origin at 0 s; default: the world's [m]
  Eigen::Vector3d rotate = Eigen::Vector3d::Zero();  ///< rotation about the fixed x axis, then y, then z [degrees]
  double thickness = 0.01;                           ///< distance that the cloth keeps from the surface [m]

  double friction = 0.5;   ///< Coulomb's coefficient
  double restitution = 0;  ///< coefficient for impacts, 0 to 1

  std::optional<Eigen::Vector3d> velocity = {};   ///< constant velocity [m/s]
  std::optional<double> orbit_period = {};        ///< period of the orbit, not 0; negative: clockwise [s]
  Eigen::Vector3d orbit_center = Orbit{}.center;  ///< point on the axis [m]
  Eigen::Vector3d orbit_axis = Orbit{}.axis;      ///< nonzero vector; counterclockwise seen from its tip
  std::vector<Keyframe> keyframes = {};           ///< positions of `center` at ascending times from 0 s on [s, m]
  Interpolation interpolation = Interpolation::linear;
  std::vector<Keyframe> turns = {};     ///< angles about the fixed x axis, then y, then z, from 0 at 0 s on [degrees]
  std::optional<BodyShape> shape = {};  ///< instead of a box or a mesh, around `center`
  bool allow_overlap = false;           ///< true: the cloth may begin inside or across, and is separated step by step

  void describe(Keys& keys);
  void check(const SimulationSettings& settings, const ProblemSink& problem) const;
  void install(System& system) const;

 private:
  [[nodiscard]] std::shared_ptr<const MovingBody> body() const;
  [[nodiscard]] std::shared_ptr<const SphereTrack> path(const std::optional<Orbit>& orbit) const;
};

/// Returns a box around the origin: eight vertices and two triangles per side, counterclockwise seen from outside.
/// @param size lengths of the sides [m]
Mesh make_box(const Eigen::Vector3d& size);

}  // namespace drape
