#pragma once

// Example:
//   drape::Effects effects{drape::Sphere{.center = Eigen::Vector3d(0, 0, -1), .radius = 0.4, .friction = 0.2}};

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "drape/sim/effects/effect.hpp"
#include "drape/sim/tracks.hpp"

namespace drape {

/// A sphere that the cloth touches at its reach, scale·radius or radius + thickness. Without friction, restitution and
/// thickness it is the homework's penalty instead: it pushes the cloth out with the acceleration
/// stiffness·(reach − ‖x − center‖). It rests at `center`, or moves straight on, on an orbit, on keyframes, or on a
/// track.
struct Sphere {
  static constexpr std::string_view name = "sphere";
  static constexpr EffectCost cost{.evaluated = 20e-9, .solved = 0.1e-6};
  static constexpr bool touches = true;
  static constexpr bool repeatable = true;

  std::optional<Eigen::Vector3d> center = {};  ///< position at 0 s [m]; may be left to keyframes or a track
  std::optional<double> radius = {};           ///< drawn radius, above 0 [m]; may be left to a track
  std::optional<double> scale = {};            ///< ratio of reach to radius; at least 1, by default 1.1
  std::optional<double> thickness = {};        ///< distance from radius to reach, instead of `scale` [m]

  std::optional<double> stiffness = {};    ///< stiffness of the push, by default 8000 [1/s²]
  double friction = 0;                     ///< Coulomb's coefficient
  std::optional<double> restitution = {};  ///< coefficient for impacts, 0 to 1; contact has none by default

  std::optional<Eigen::Vector3d> velocity = {};   ///< constant velocity [m/s]
  std::optional<double> orbit_period = {};        ///< period of the orbit, not 0; negative: clockwise [s]
  Eigen::Vector3d orbit_center = Orbit{}.center;  ///< point on the axis [m]
  Eigen::Vector3d orbit_axis = Orbit{}.axis;      ///< nonzero vector; counterclockwise seen from its tip
  std::vector<Keyframe> keyframes = {};           ///< positions of the centre at ascending times from 0 s on [s, m]
  Interpolation interpolation = Interpolation::linear;
  std::shared_ptr<const SphereTrack> track = {};  ///< position and, unless `radius` is given, size
  bool allow_overlap = false;                     ///< true: the cloth may begin inside, and is separated step by step

  void describe(Keys& keys);
  void check(const SimulationSettings& settings, const ProblemSink& problem) const;
  void install(System& system) const;

  static constexpr double usual_scale = 1.1;       ///< default without scale and thickness
  static constexpr double usual_stiffness = 8000;  ///< default of the push [1/s²]

 private:
  /// Returns true for the homework's push, false for contact.
  [[nodiscard]] bool pushes() const { return friction == 0 && !restitution && !thickness; }
  void check_push(const SimulationSettings& settings, const ProblemSink& problem) const;
  [[nodiscard]] std::shared_ptr<const SphereTrack> motion() const;
};

}  // namespace drape
