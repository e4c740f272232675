#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "sim/collision/distance.hpp"

namespace drape {

/// Velocities and inverse masses of vertices, as input and output of RigidZones.
struct MovingVertices {
  std::vector<Point> velocities;       ///< [m/s]
  std::vector<double> inverse_masses;  ///< 0 for a pin [1/kg]

  [[nodiscard]] Point velocity(int i) const { return velocities[static_cast<std::size_t>(i)]; }
  [[nodiscard]] double inverse_mass(int i) const { return inverse_masses[static_cast<std::size_t>(i)]; }
};

/// Groups of vertices that move as rigid bodies for one step, used when impulses cannot resolve a pile of collisions
/// (Provot 1997; Bridson, Fedkiw and Anderson 2002, section 7.5; Harmon et al. 2008). A group keeps the linear and
/// angular momentum of its vertices: v = v̄ + ω × (x − x̄). On the path x + t·v no two of its points approach each
/// other, since I + t·[ω]× shortens no vector. So there is no collision inside a group.
/// A group with a pin moves with the pin.
class RigidZones {
 public:
  /// Begins a step with each vertex in a zone of its own.
  /// @param velocities of the vertices, which define the zones' momenta
  void begin(const std::vector<Point>& velocities);

  /// Joins the zones of four vertices.
  void join(const std::array<int, 4>& vertices);
  /// Joins all zones of more than one vertex into one.
  void join_all();
  /// Returns true if four vertices are in one zone.
  [[nodiscard]] bool together(const std::array<int, 4>& vertices) const;

  /// Sets the velocities of all vertices in zones of more than one vertex.
  /// @return false if a zone has pins with different velocities and so cannot be rigid
  bool apply(const std::vector<Point>& x, MovingVertices& vertices);

 private:
  /// Sums over the vertices of a zone.
  struct Body {
    double mass = 0;
    Point center = Point::Zero(), velocity = Point::Zero(), spin = Point::Zero();  // first sums, then means
    Point angular_momentum = Point::Zero();
    Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
    int pins = 0;
    bool uneven = false;  // true if its pins have different velocities
  };

  [[nodiscard]] int root(int vertex) const;
  void sum_up(const std::vector<Point>& x, const MovingVertices& vertices);

  std::vector<int> parents_;
  std::vector<Point> velocities_;
  std::vector<Body> bodies_;      // by root
  std::vector<int> members_;      // vertices of zones of more than one
  std::vector<char> zone_roots_;  // nonzero at roots of such zones
};

}  // namespace drape
