#pragma once

#include <Eigen/Core>
#include <vector>

#include "audit/surface.hpp"
#include "sim/collider.hpp"

namespace drape::audit {

/// Vertices that may stand still: what holds them is known, or they are all that never move before others do.
struct Held {
  bool known = false;         ///< false: a vertex that has not moved since the first state is held
  std::vector<int> vertices;  ///< such as pins
};

/// Finds the vertices that stand still in mid-air while others fall.
///
/// A vertex is stuck where three things hold at once:
/// - it has not moved for at least two steps, by more than 10⁻⁹ of a mean edge in each;
/// - over that time, a vertex that shares an edge with it has fallen by a quarter of that edge or more;
/// - nothing supports it: it is no held vertex, and further than half a mean edge from every collider, with its layer
/// of
///   contact, and from every triangle of the cloth that it is no corner of.
class StuckWatch {
 public:
  /// @param cloth outlives this
  /// @param rest  positions at rest, for the length of a mean edge [m]
  /// @param down  unit vector along which things fall; zero: nothing falls
  StuckWatch(const Topology& cloth, const Vertices& rest, const Held& held, Eigen::Vector3d down);

  /// Takes the next state. @returns the vertices that are stuck in it, ascending
  std::vector<int> add(const Vertices& x, const std::vector<Collider>& colliders);

 private:
  [[nodiscard]] bool supported(int vertex, const Vertices& x, const std::vector<Collider>& colliders) const;

  const Topology& cloth_;
  bool held_known_;
  Eigen::Vector3d down_;
  double mean_edge_ = 0;
  Vertices before_;
  std::vector<char> held_;
  std::vector<int> still_;    // steps without a motion
  std::vector<double> fall_;  // of the neighbours meanwhile, in lengths of the edge
};

}  // namespace drape::audit
