#pragma once

#include <memory>
#include <vector>

#include "sim/collision/placed_mesh.hpp"
#include "sim/mesh_motion.hpp"
#include "sim/rigid_motion.hpp"

namespace drape {

/// A body at one moment: its mesh in its own coordinates, and where those are.
struct BodyAt {
  std::shared_ptr<const PlacedMesh> mesh;
  Pose pose;
};

/// A mesh that moves as a whole and may change its shape, as a function of time. It keeps the shapes of the last few
/// times that it was asked for: for one thread at a time.
class MovingBody {
 public:
  MovingBody(std::shared_ptr<const MeshMotion> shape, RigidMotion motion);

  [[nodiscard]] BodyAt at(double time) const { return {mesh_at(time), motion_.at(time)}; }
  /// Whether its shape changes.
  [[nodiscard]] bool deforms() const { return !shape_->samples.empty(); }
  [[nodiscard]] const MeshTopology& topology() const { return *topology_; }

  /// How far the point of a triangle with these weights goes from one time to another [s], and the body's origin [m].
  [[nodiscard]] Eigen::Vector3d displacement(int triangle, const Point& weights, double from, double to) const;
  [[nodiscard]] Eigen::Vector3d displacement(double from, double to) const;

  /// Where its vertices are in the world, n×3 [m].
  [[nodiscard]] Vertices positions(double time) const;

 private:
  struct Shape {
    double time;
    std::shared_ptr<PlacedMesh> mesh;
  };
  [[nodiscard]] std::shared_ptr<const PlacedMesh> mesh_at(double time) const;
  [[nodiscard]] Point point_at(int triangle, const Point& weights, double time) const;

  std::shared_ptr<const MeshMotion> shape_;
  RigidMotion motion_;
  std::shared_ptr<const MeshTopology> topology_;
  mutable std::vector<Shape> shapes_;  // the last one that was asked for is the last one here
  mutable Vertices scratch_;
};

}  // namespace drape
