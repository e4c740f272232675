#include "tests/support/matrices.hpp"

#include <algorithm>
#include <vector>

namespace drape::test {
namespace {

std::vector<bool> pinned(const Cloth& cloth) {
  std::vector<bool> is_pin(static_cast<std::size_t>(cloth.vertex_count()), false);
  for (const int pin : cloth.pins) is_pin[static_cast<std::size_t>(pin)] = true;
  return is_pin;
}

/// Assembles M/h² + the sum over the springs of [K −K; −K K], with blocks of `size` rows per vertex.
template <class Block>
SparseMatrix assemble(const System& system, int size, const Block& block_of) {
  const Cloth& cloth = system.cloth;
  const std::vector<bool> is_pin = pinned(cloth);
  std::vector<Eigen::Triplet<double>> entries;
  for (int vertex = 0; vertex < cloth.vertex_count(); ++vertex) {
    const double inertia =
        is_pin[static_cast<std::size_t>(vertex)] ? 1 : cloth.masses[vertex] / system.step / system.step;
    for (int axis = 0; axis < size; ++axis) entries.emplace_back(size * vertex + axis, size * vertex + axis, inertia);
  }
  for (const Spring& spring : system.springs) {
    const Eigen::MatrixXd block = block_of(spring);
    for (const auto& [row, column] : {std::pair{spring.i, spring.i}, std::pair{spring.i, spring.j},
                                      std::pair{spring.j, spring.i}, std::pair{spring.j, spring.j}}) {
      if (is_pin[static_cast<std::size_t>(row)] || is_pin[static_cast<std::size_t>(column)]) continue;
      for (int a = 0; a < size; ++a) {
        for (int b = 0; b < size; ++b) {
          entries.emplace_back(size * row + a, size * column + b, row == column ? block(a, b) : -block(a, b));
        }
      }
    }
  }
  const Eigen::Index rows = Eigen::Index{size} * cloth.vertex_count();
  SparseMatrix matrix(rows, rows);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

}  // namespace

SparseMatrix constant_matrix(const System& system) {
  return assemble(system, 1, [](const Spring& spring) { return Eigen::MatrixXd::Constant(1, 1, spring.stiffness); });
}

SparseMatrix newton_matrix(const System& system, const Vertices& x) {
  return assemble(system, 3, [&](const Spring& spring) -> Eigen::MatrixXd {
    const Eigen::Vector3d d = x.row(spring.i) - x.row(spring.j);
    const Eigen::Matrix3d along = d * d.transpose() / d.squaredNorm();
    const double across = std::max(0.0, 1 - spring.rest_length / d.norm());
    return spring.stiffness * (along + across * (Eigen::Matrix3d::Identity() - along));
  });
}

}  // namespace drape::test
