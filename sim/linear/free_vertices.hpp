#pragma once

#include <vector>

#include "sim/cloth.hpp"
#include "sim/linear/sparse_cholesky.hpp"
#include "sim/system.hpp"

namespace drape {

/// Number of free vertices from which ConstantFactor uses its own factorisation.
inline constexpr int large_cloth = 20'000;
/// Number of free vertices from which more knowledge of the Hessian pays off: conjugate gradients use its diagonal
/// (HessianDiagonal), and quasi-Newton takes some Newton steps. Smaller cloth keeps the bits of former versions.
inline constexpr int fine_cloth = 1'000;

/// The unknowns of an implicit step: the unpinned vertices, numbered from 0 in the order of the cloth. This is the
/// selection matrix of the reduced system.
class FreeVertices {
 public:
  explicit FreeVertices(const Cloth& cloth);

  [[nodiscard]] int count() const { return static_cast<int>(vertices_.size()); }
  /// Returns the vertex of a free number.
  [[nodiscard]] int vertex(int number) const { return vertices_[static_cast<std::size_t>(number)]; }
  /// Returns the free number of a vertex, −1 for a pin.
  [[nodiscard]] int number(int vertex) const { return numbers_[static_cast<std::size_t>(vertex)]; }

  /// Returns their positions in the rest shape, or the initial ones if there is none, n×3 [m].
  [[nodiscard]] Vertices rest_places(const Cloth& cloth) const;

 private:
  std::vector<int> vertices_, numbers_;
};

/// Returns the lower triangle of a matrix that couples the free ends of every pair, with its whole diagonal.
LowerPattern spring_pattern(const StiffnessBound& bound, const FreeVertices& free);

}  // namespace drape
