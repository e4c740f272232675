#pragma once

#include <cmath>

#include "drape/sim/mesh.hpp"
#include "sim/kernels/kernels.hpp"

namespace drape {

/// Returns the columns of n×3 numbers from a row on, as arguments of kernels.
inline Columns<const double> columns(const Vertices& v, Eigen::Index row = 0) {
  return {v.col(0).data() + row, v.col(1).data() + row, v.col(2).data() + row};
}
inline Columns<double> columns(Vertices& v, Eigen::Index row = 0) {
  return {v.col(0).data() + row, v.col(1).data() + row, v.col(2).data() + row};
}

/// Returns Σ a·b over all numbers, with the same bits on every processor.
inline double dot(const Vertices& a, const Vertices& b) {
  const double* vector = a.data();
  double result = 0;
  kernels().dots(static_cast<std::size_t>(a.size()), 1, &vector, b.data(), &result);
  return result;
}

/// Returns the 2-norm over all numbers.
inline double norm(const Vertices& v) { return std::sqrt(dot(v, v)); }

}  // namespace drape
