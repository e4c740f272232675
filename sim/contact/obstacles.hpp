#pragma once

#include <algorithm>
#include <memory>
#include <utility>

#include "sim/sphere_track.hpp"

namespace drape {

/// A fixed half-space for SurfaceContacts.
struct PlaneObstacle {
  struct Placed {
    Eigen::Vector3d center = Eigen::Vector3d::Zero(), up = Eigen::Vector3d::UnitZ();

    [[nodiscard]] double gap(const Eigen::Vector3d& place) const { return up.dot(place); }
    [[nodiscard]] double margin() const { return 0; }
    [[nodiscard]] bool crosses(const Eigen::Vector3d&, const Eigen::Vector3d&, double) const { return false; }
    [[nodiscard]] Eigen::Vector3d surface_point(const Eigen::Vector3d&) const { return Eigen::Vector3d::Zero(); }
    [[nodiscard]] Eigen::Vector3d normal_on_way(const Eigen::Vector3d&, const Eigen::Vector3d&, double) const {
      return up;
    }
  };

  Eigen::Vector3d up;  ///< outward unit normal
  double height;       ///< of the surface above the origin, along `up` [m]

  [[nodiscard]] Placed at(double) const { return {height * up, up}; }
};

/// A moving sphere for SurfaceContacts.
struct BallObstacle {
  struct Placed {
    Eigen::Vector3d center = Eigen::Vector3d::Zero();
    double radius = 0;

    [[nodiscard]] double gap(const Eigen::Vector3d& place) const { return place.norm() - radius; }
    [[nodiscard]] double margin() const { return 0.05 * radius; }
    [[nodiscard]] Eigen::Vector3d surface_point(const Eigen::Vector3d& normal) const { return radius * normal; }

    /// Returns true if a straight path between two outside positions cuts deeper than the sphere's rim.
    [[nodiscard]] bool crosses(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double distance) const {
      return nearest_on_way(from, to).norm() < rim * (radius + distance);
    }
    [[nodiscard]] Eigen::Vector3d normal_on_way(const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                                                double distance) const {
      const double reach = radius + distance;
      const Eigen::Vector3d nearest = nearest_on_way(from, to);
      if (from.norm() < reach || nearest.norm() >= rim * reach) {
        return to.isZero(0) ? Eigen::Vector3d(from.normalized()) : Eigen::Vector3d(to.normalized());
      }
      // Point of entry: |from + t·way| = reach.
      const Eigen::Vector3d way = to - from;
      const double a = way.squaredNorm(), b = from.dot(way), c = from.squaredNorm() - reach * reach;
      const double t = (-b - std::sqrt(std::max(0.0, b * b - a * c))) / a;
      return (from + t * way).normalized();
    }

   private:
    static constexpr double rim = 0.9;  // a path that stays outside this fraction of the reach only crosses the rim

    [[nodiscard]] static Eigen::Vector3d nearest_on_way(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
      const Eigen::Vector3d way = to - from;
      const double squared = way.squaredNorm();
      const double t = squared > 0 ? std::clamp(-from.dot(way) / squared, 0.0, 1.0) : 0.0;
      return from + t * way;
    }
  };

  std::shared_ptr<const SphereTrack> track;
  double scale = 1;  ///< factor on the track's radius

  [[nodiscard]] Placed at(double time) const {
    const SphereShape shape = track->at(time);
    return {shape.center, scale * shape.radius};
  }
};

}  // namespace drape
