#pragma once

// Example:
//   drape::Effects effects{drape::Sphere{.center = Eigen::Vector3d(0, 0, -1), .radius = 0.4, .friction = 0.2}};

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "sim/effects/effect.hpp"
#include "sim/keyframes.hpp"
#include "sim/sphere_track.hpp"

namespace drape {

/// A sphere that the cloth touches at its reach, which is scale·radius or radius + thickness. One without friction,
/// restitution and thickness is the homework's penalty instead: it pushes the cloth out with the acceleration
/// stiffness·(reach − ‖x − center‖). It rests at `center`, or moves in one of four ways:
/// straight on, on an orbit, on keyframes, or on a track.
struct Sphere {
  static constexpr std::string_view name = "sphere";
  static constexpr EffectCost cost{.evaluated = 20e-9, .solved = 0.1e-6};
  static constexpr bool touches = true;
  static constexpr bool repeatable = true;

  std::optional<Eigen::Vector3d> center = {};  ///< at 0 s [m]; without one, keyframes or a track say where it is
  std::optional<double> radius = {};           ///< as it is drawn, above 0 [m]; may be left to a track
  std::optional<double> scale = {};            ///< it reaches to scale·radius from the centre; at least 1, usually 1.1
  std::optional<double> thickness = {};        ///< or this far beyond its radius [m]

  std::optional<double> stiffness = {};    ///< of the push, usually 8000 [1/s²]
  double friction = 0;                     ///< Coulomb's coefficient
  std::optional<double> restitution = {};  ///< of impacts, 0 to 1; contact has none without

  std::optional<Eigen::Vector3d> velocity = {};   ///< straight on [m/s]
  std::optional<double> orbit_period = {};        ///< of a turn, not 0; negative: the other way round [s]
  Eigen::Vector3d orbit_center = Orbit{}.center;  ///< a point of the axis [m]
  Eigen::Vector3d orbit_axis = Orbit{}.axis;      ///< of any length but 0; counterclockwise seen from its tip
  std::vector<Keyframe> keyframes = {};           ///< of the centre, at increasing times from 0 s on [s, m]
  Interpolation interpolation = Interpolation::linear;
  std::shared_ptr<const SphereTrack> track = {};  ///< place and, unless `radius` is given, size

  void describe(Keys& keys);
  void check(const SimulationSettings& settings, const ProblemSink& problem) const;
  void install(System& system) const;

  static constexpr double usual_scale = 1.1;       ///< where neither scale nor thickness says how far it reaches
  static constexpr double usual_stiffness = 8000;  ///< of the push [1/s²]

 private:
  /// Returns true if it is the homework's push and no contact.
  [[nodiscard]] bool pushes() const { return friction == 0 && !restitution && !thickness; }
  void check_push(const SimulationSettings& settings, const ProblemSink& problem) const;
  [[nodiscard]] std::shared_ptr<const SphereTrack> motion() const;
};

}  // namespace drape
