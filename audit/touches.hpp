#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

#include "audit/passages.hpp"

namespace drape::audit {

/// Number of directions in which touching features are displaced. Direction 2i + 1 is opposite to 2i.
inline constexpr int direction_count = 14;

/// Returns a direction of length 1; no symmetry of meshes has it.
Eigen::Vector3d direction(int number);

/// Returns the length of displacements for meshes with these positions [m]: tiny, but thousands of roundings.
double displacement(const Vertices& a, const Vertices& b);

/// A set of directions: bit k is direction k.
using Directions = unsigned;
inline constexpr Directions all_directions = (1U << direction_count) - 1;

/// The triangles at each vertex of a mesh, ascending.
std::vector<std::vector<int>> triangles_at_vertices(const Topology& mesh, Eigen::Index vertices);

/// Decides which touches of a step are passages.
///
/// A triangle passes through a surface that it only touches if it meets the surface wherever it is displaced a little.
/// It only touches if a displacement in one direction frees it: it slides, rests, or grazes a ridge. The displaced
/// features are tested exactly, and of the pairs that touch, those that meet under one fixed displacement become
/// passages. A vertex that goes through the common edge of two triangles thus passes one of them.
///
/// Directions are kept from step to step: a triangle may come from above to rest in a surface, and leave it below.
class Touches {
 public:
  /// Processes the next step.
  /// @param body  nothing: passages of the cloth through itself
  /// @param found all passages of the step; its proven ones lose `touch`
  void resolve(const SurfaceMotion& cloth, const SurfaceMotion* body, std::vector<Passage>& found);

 private:
  std::map<std::pair<Owner, int>, Directions> met_;  // of each touching triangle
};

}  // namespace drape::audit
