#pragma once

#include <limits>

#include "sim/effects/surface_contact.hpp"
#include "sim/mesh.hpp"
#include "sim/parallel/part_lists.hpp"
#include "sim/parallel/vectors.hpp"

namespace drape {

/// A vertex inside a surface, and how.
struct TouchedVertex {
  Eigen::Index vertex;
  SurfaceContact contact;
};

/// What a surface touches when a step begins, as the push finds it, for the friction in the same place at the same
/// time.
struct TouchedVertices {
  double time = std::numeric_limits<double>::quiet_NaN();  // of nothing yet [s]
  Vertices x;
  PartLists<TouchedVertex> all;

  /// Takes memory for as many, so that no step has to.
  explicit TouchedVertices(Eigen::Index most) : x(most, 3) { all.reserve(most); }
  [[nodiscard]] bool are_those_of(const Vertices& places, double at, const Threads& threads) const {
    return time == at && equal(threads, x, places);
  }
};

}  // namespace drape
