#include "sim/grid_springs.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace drape {

void stiffen_evenly(double modulus, Cloth& cloth) {
  stiffen_by_area(modulus, cloth);
  // Springs along x, along y and diagonal, each with Σ k l² over the cloth.
  std::array<double, 3> sums{};
  double aslant_x = 0, aslant_y = 0;
  const auto kind = [&](const Eigen::RowVector3d& along) {
    const double least = 1e-6 * along.norm();
    if (std::abs(along.y()) < least) return std::size_t{0};
    return std::abs(along.x()) < least ? std::size_t{1} : std::size_t{2};
  };
  for (const Spring& s : cloth.springs) {
    const Eigen::RowVector3d along = cloth.rest.row(s.j) - cloth.rest.row(s.i);
    sums[kind(along)] += s.stiffness * along.squaredNorm();
    if (kind(along) != 2) continue;
    aslant_x += along.x() * along.x();
    aslant_y += along.y() * along.y();
  }
  // With c = cos² and s = sin² of the diagonals' angle, these shares make Σ k l² n⊗n⊗n⊗n per area isotropic. There are
  // three, as every triangle has three sides.
  const double c = aslant_x / (aslant_x + aslant_y), s = 1 - c;
  const std::array shares{9.0 / 8 - 3.0 / 8 * c / s, 9.0 / 8 - 3.0 / 8 * s / c, 3.0 / 8 / (c * s)};
  if (!(std::ranges::min(shares) > 0)) return;
  const double whole = (sums[0] + sums[1] + sums[2]) / 3;
  for (Spring& spring : cloth.springs) {
    const std::size_t k = kind(cloth.rest.row(spring.j) - cloth.rest.row(spring.i));
    spring.stiffness *= shares[k] * whole / sums[k];
  }
}

std::vector<Spring> springs_of_grid(int columns, const Vertices& rest, const GridSprings& stiffnesses) {
  const int stride = columns + 1, rows = static_cast<int>(rest.rows()) / stride;
  std::vector<Spring> springs;
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < stride; ++i) {
      const auto add = [&](int right, int up, double stiffness) {
        if (i + right < 0 || i + right >= stride || j + up >= rows) return;
        const int from = j * stride + i, to = from + up * stride + right;
        const double length = (rest.row(to) - rest.row(from)).norm();
        springs.push_back({.i = from, .j = to, .rest_length = length, .stiffness = stiffness});
      };
      add(1, 0, stiffnesses.structural);
      add(2, 0, stiffnesses.bend);
      add(-1, 1, stiffnesses.shear);
      add(0, 1, stiffnesses.structural);
      add(1, 1, stiffnesses.shear);
      add(0, 2, stiffnesses.bend);
    }
  }
  return springs;
}

}  // namespace drape
