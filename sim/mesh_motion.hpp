#pragma once

// Example:
//   drape::MeshMotion lift{.mesh = drape::make_grid(1, 1)};
//   lift.times = {0, 2};
//   lift.samples = {lift.mesh.positions, lift.mesh.positions.array() + 1};
//   drape::Vertices x;
//   lift.place(1, x);  // half-way

#include <vector>

#include "sim/mesh.hpp"

namespace drape {

/// A triangle mesh whose vertices move: where they are is a function of time alone. A mesh that keeps its place has no
/// samples.
struct MeshMotion {
  Mesh mesh;                       ///< its triangles hold at every time; its positions are those of the first sample
  std::vector<double> times = {};  ///< of the samples, increasing [s]
  std::vector<Vertices> samples = {};  ///< one per time: n×3 [m]

  /// Writes the positions at a time [s], n×3 [m]: linear between two samples, which is how USD interpolates points and
  /// matrices; before the first and after the last sample those of that sample.
  void place(double time, Vertices& x) const;
};

}  // namespace drape
