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

  /// How far its points go between two moments.
  class Way {
   public:
    Way(const MovingBody& body, double from, double to);
    /// The point of a triangle with these weights [m].
    [[nodiscard]] Eigen::Vector3d of(int triangle, const Point& weights) const;

   private:
    const MeshTopology& topology_;
    BodyAt from_, to_;
    bool still_;
  };

  [[nodiscard]] BodyAt at(double time) const { return {mesh_at(time), motion_.at(time)}; }
  /// Whether its shape changes.
  [[nodiscard]] bool deforms() const { return !shape_->samples.empty(); }
  [[nodiscard]] const MeshTopology& topology() const { return *topology_; }

  /// How far the body's origin goes from one time to another [s] [m].
  [[nodiscard]] Eigen::Vector3d displacement(double from, double to) const;

  /// Where its vertices are in the world, n×3 [m].
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
  mutable std::vector<Shape> shapes_;  // the last one that was asked for is the last one here
  mutable Vertices scratch_, last_;    // the shape that was made last, and how far that was from the first
  mutable double travel_ = 0;
};

}  // namespace drape
