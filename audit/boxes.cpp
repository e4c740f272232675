#include "audit/boxes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "audit/expansion.hpp"

namespace drape::audit {

Vertices exact_positions(const Vertices& x) {
  Vertices exact(x.rows(), 3);
  for (Eigen::Index v = 0; v < x.rows(); ++v) {
    try {
      for (int axis = 0; axis < 3; ++axis) exact(v, axis) = on_exact_grid(x(v, axis));
    } catch (const std::invalid_argument& error) {
      throw std::invalid_argument(fmt::format("vertex {}: {}", v, error.what()));
    }
  }
  return exact;
}

void check_vertices(const std::vector<Triangle>& triangles, const Vertices& x) {
  for (const Triangle& triangle : triangles) {
    const int largest = *std::ranges::max_element(triangle);
    if (largest >= x.rows()) {
      throw std::invalid_argument(fmt::format("a triangle has vertex {}, but there are {}", largest, x.rows()));
    }
  }
}

}  // namespace drape::audit
