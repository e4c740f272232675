#pragma once

#include <algorithm>
#include <memory>
#include <utility>

#include "sim/sphere_track.hpp"

namespace drape {

/// A half-space, as SurfaceContacts takes it. It does not move.
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

  Eigen::Vector3d up;  ///< unit vector out of it
  double height;       ///< of its surface above the origin, along that [m]

  [[nodiscard]] Placed at(double) const { return {height * up, up}; }
};

/// A ball that moves, as SurfaceContacts takes it.
struct BallObstacle {
  struct Placed {
    Eigen::Vector3d center = Eigen::Vector3d::Zero();
    double radius = 0;

    [[nodiscard]] double gap(const Eigen::Vector3d& place) const { return place.norm() - radius; }
    [[nodiscard]] double margin() const { return 0.05 * radius; }
    [[nodiscard]] Eigen::Vector3d surface_point(const Eigen::Vector3d& normal) const { return radius * normal; }

    /// Whether what goes straight from one place to another, both outside, passes through more than the rim.
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
      // Where it enters: |from + t·way| = reach.
      const Eigen::Vector3d way = to - from;
      const double a = way.squaredNorm(), b = from.dot(way), c = from.squaredNorm() - reach * reach;
      const double t = (-b - std::sqrt(std::max(0.0, b * b - a * c))) / a;
      return (from + t * way).normalized();
    }

   private:
    static constexpr double rim = 0.9;  // part of the reach within which a way is not only across the rim

    [[nodiscard]] static Eigen::Vector3d nearest_on_way(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
      const Eigen::Vector3d way = to - from;
      const double squared = way.squaredNorm();
      const double t = squared > 0 ? std::clamp(-from.dot(way) / squared, 0.0, 1.0) : 0.0;
      return from + t * way;
    }
  };

  std::shared_ptr<const SphereTrack> track;
  double scale = 1;  ///< of its radius

  [[nodiscard]] Placed at(double time) const {
    const SphereShape shape = track->at(time);
    return {shape.center, scale * shape.radius};
  }
};

}  // namespace drape
