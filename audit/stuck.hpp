#pragma once

#include <Eigen/Core>
#include <vector>

#include "audit/surface.hpp"
#include "sim/collider.hpp"

namespace drape::audit {

/// Vertices that may rest: known ones, or all that do not move before others do.
struct Held {
  bool known = false;         ///< false: vertices that have not moved since the first state are held
  std::vector<int> vertices;  ///< known held vertices, such as pins
};

/// Detector of vertices that rest in mid-air while others fall.
///
/// A vertex is stuck if three conditions hold at once:
/// - it has rested for at least two steps: each moved it by at most 10⁻⁹ of a mean edge;
/// - meanwhile, a vertex that shares an edge with it has fallen by a quarter of that edge or more;
/// - it has no support: it is free, and more than half a mean edge away from each collider's contact layer and each
///   cloth triangle without this vertex.
class StuckWatch {
 public:
  /// @param cloth must outlive this
  /// @param rest  rest positions, for the mean edge length [m]
  /// @param down  unit vector along which things fall; zero: nothing falls
  StuckWatch(const Topology& cloth, const Vertices& rest, const Held& held, Eigen::Vector3d down);

  /// Processes the next state. @returns the stuck vertices, ascending
  std::vector<int> add(const Vertices& x, const std::vector<Collider>& colliders);

 private:
  [[nodiscard]] bool supported(int vertex, const Vertices& x, const std::vector<Collider>& colliders) const;

  const Topology& cloth_;
  bool held_known_;
  Eigen::Vector3d down_;
  double mean_edge_ = 0;
  Vertices before_;
  std::vector<char> held_;
  std::vector<int> still_;    // steps without motion
  std::vector<double> fall_;  // fall of the neighbours meanwhile, relative to the edge
};

}  // namespace drape::audit
