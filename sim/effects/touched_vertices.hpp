#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "sim/effects/surface_contact.hpp"
#include "sim/mesh.hpp"

namespace drape {

/// What a surface touches when a step begins, as the push finds it, for the friction in the same place at the same
/// time.
struct TouchedVertices {
  struct Touched {
    Eigen::Index vertex;
    SurfaceContact contact;
  };

  double time = std::numeric_limits<double>::quiet_NaN();  // of nothing yet [s]
  Vertices x;
  std::vector<Touched> all;

  /// Takes memory for as many, so that no step has to.
  explicit TouchedVertices(Eigen::Index most) : x(most, 3) { all.reserve(static_cast<std::size_t>(most)); }
  [[nodiscard]] bool are_those_of(const Vertices& places, double at) const { return time == at && x == places; }
};

}  // namespace drape
