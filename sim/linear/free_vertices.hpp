#pragma once

#include <vector>

#include "sim/cloth.hpp"
#include "sim/linear/sparse_cholesky.hpp"
#include "sim/system.hpp"

namespace drape {

/// From so many free vertices on a cloth's constant matrix has a factor of our own (ConstantFactor).
inline constexpr int large_cloth = 20'000;
/// From so many on it pays to know more of the Hessian than that matrix does: conjugate gradients know its diagonal
/// (HessianDiagonal), and quasi-Newton takes some of Newton's steps. Smaller cloth keeps the bits that it has always
/// had.
inline constexpr int fine_cloth = 1'000;

/// The unknowns of an implicit step: the vertices that are not pinned, numbered from 0 in the order of the cloth. This
/// is the reduced system's selection matrix.
class FreeVertices {
 public:
  explicit FreeVertices(const Cloth& cloth);

  [[nodiscard]] int count() const { return static_cast<int>(vertices_.size()); }
  /// The vertex of a free number.
  [[nodiscard]] int vertex(int number) const { return vertices_[static_cast<std::size_t>(number)]; }
  /// The free number of a vertex, −1 for a pin.
  [[nodiscard]] int number(int vertex) const { return numbers_[static_cast<std::size_t>(vertex)]; }

  /// Where they are in the rest shape, or where the cloth starts if it has none, n×3 [m].
  [[nodiscard]] Vertices rest_places(const Cloth& cloth) const;

 private:
  std::vector<int> vertices_, numbers_;
};

/// The lower triangle of a matrix that couples the two free ends of every pair, and has its whole diagonal.
LowerPattern spring_pattern(const StiffnessBound& bound, const FreeVertices& free);

}  // namespace drape
