#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "sim/collision/distance.hpp"

namespace drape {

/// Velocities of vertices, which zones change.
struct MovingVertices {
  std::vector<Point> velocities;       ///< [m/s]
  std::vector<double> inverse_masses;  ///< 0 for a pin [1/kg]

  [[nodiscard]] Point velocity(int i) const { return velocities[static_cast<std::size_t>(i)]; }
  [[nodiscard]] double inverse_mass(int i) const { return inverse_masses[static_cast<std::size_t>(i)]; }
};

/// Groups of vertices that move as rigid bodies for one step: the way out where impulses do not settle a pile of
/// collisions (Provot 1997; Bridson, Fedkiw and Anderson 2002, section 7.5; Harmon et al. 2008). A group has the linear
/// and angular momentum that its vertices had: v = v̄ + ω × (x − x̄). On the way x + t·v no two of its points come nearer
/// to each other, since I + t·[ω]× shortens no vector: so there is no collision inside a group.
/// A group with a pin moves as the pin does.
class RigidZones {
 public:
  /// Begins a step, with every vertex by itself.
  /// @param velocities of the vertices, which the zones' momenta are taken from
  void begin(const std::vector<Point>& velocities);

  /// Joins the zones of four vertices.
  void join(const std::array<int, 4>& vertices);
  /// Joins all zones of more than one vertex into one.
  void join_all();
  /// Whether four vertices are in one zone.
  [[nodiscard]] bool together(const std::array<int, 4>& vertices) const;

  /// Sets the velocities of the vertices of all zones of more than one vertex.
  /// @return false if a zone holds pins that move differently, so that it cannot be rigid
  bool apply(const std::vector<Point>& x, MovingVertices& vertices);

 private:
  /// What a zone's vertices have together.
  struct Body {
    double mass = 0;
    Point center = Point::Zero(), velocity = Point::Zero(), spin = Point::Zero();  // first sums, then means
    Point angular_momentum = Point::Zero();
    Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
    int pins = 0;
    bool uneven = false;  // its pins move differently
  };

  [[nodiscard]] int root(int vertex) const;
  void sum_up(const std::vector<Point>& x, const MovingVertices& vertices);

  std::vector<int> parents_;
  std::vector<Point> velocities_;
  std::vector<Body> bodies_;      // by root
  std::vector<int> members_;      // vertices of zones of more than one
  std::vector<char> zone_roots_;  // whether a vertex is the root of such a zone
};

}  // namespace drape
