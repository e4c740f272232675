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

/// A triangle mesh whose vertices move as a function of time. A fixed mesh has no samples.
struct MeshMotion {
  Mesh mesh;                           ///< triangles for all times, and positions of the first sample
  std::vector<double> times = {};      ///< times of the samples, ascending [s]
  std::vector<Vertices> samples = {};  ///< one per time: n×3 [m]

  /// Writes the positions at a time [s], n×3 [m]. Interpolates linearly between two samples, as USD does for points and
  /// matrices; constant before the first and after the last sample.
  void place(double time, Vertices& x) const;
};

}  // namespace drape
