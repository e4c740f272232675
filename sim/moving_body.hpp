#pragma once

#include <memory>
#include <vector>

#include "sim/collision/placed_mesh.hpp"
#include "sim/mesh_motion.hpp"
#include "sim/rigid_motion.hpp"

namespace drape {

/// A body at one moment: its mesh in its own coordinates, and the pose of these.
struct BodyAt {
  std::shared_ptr<const PlacedMesh> mesh;
  Pose pose;
};

/// A mesh with a rigid motion and a changing shape, as functions of time. Caches the shapes of the last few times, so
/// one object serves one thread at a time.
class MovingBody {
 public:
  MovingBody(std::shared_ptr<const MeshMotion> shape, RigidMotion motion);

  /// Displacement of the body's points between two times.
  class Way {
   public:
    Way(const MovingBody& body, double from, double to);
    /// Returns the displacement of the point of a triangle with these weights [m].
    [[nodiscard]] Eigen::Vector3d of(int triangle, const Point& weights) const;

   private:
    const MeshTopology& topology_;
    BodyAt from_, to_;
    bool still_;
  };

  [[nodiscard]] BodyAt at(double time) const { return {mesh_at(time), motion_.at(time)}; }
  /// Returns true if the shape changes.
  [[nodiscard]] bool deforms() const { return !shape_->samples.empty(); }
  [[nodiscard]] const MeshTopology& topology() const { return *topology_; }

  /// Returns the displacement of the body's origin from one time to another [s] [m].
  [[nodiscard]] Eigen::Vector3d displacement(double from, double to) const;

  /// Returns the vertices' positions in the world, n×3 [m].
  [[nodiscard]] Vertices positions(double time) const;

 private:
  struct Shape {
    double time;
    std::shared_ptr<PlacedMesh> mesh;
  };
  [[nodiscard]] std::shared_ptr<const PlacedMesh> mesh_at(double time) const;

  std::shared_ptr<const MeshMotion> shape_;
  RigidMotion motion_;
  std::shared_ptr<const MeshTopology> topology_;
  mutable std::vector<Shape> shapes_;  // most recently used last
  mutable Vertices scratch_, last_;    // last shape computed, and scratch
  mutable double travel_ = 0;
};

}  // namespace drape
