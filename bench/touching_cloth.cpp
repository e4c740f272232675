#include "bench/touching_cloth.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "bench/moving_cloth.hpp"

namespace drape {

Cloth make_folded_cloth(int cells) {
  Cloth cloth = make_moving_cloth(cells);
  cloth.positions = cloth.rest;
  cloth.velocities.setZero();
  constexpr double layer = 0.5, gap = 0.012;  // [m]
  for (Eigen::Index i = 0; i < cloth.positions.rows(); ++i) {
    const double along = cloth.positions(i, 0) + 1;
    const int number = std::min(3, static_cast<int>(along / layer));
    const double within = along - number * layer;
    cloth.positions(i, 0) = number % 2 == 0 ? within : layer - within;
    cloth.positions(i, 2) = gap * (number + within / layer);
  }
  return cloth;
}

Body make_cushion() {
  constexpr int cells = 70;
  Mesh mesh = make_grid(cells, cells);
  for (Eigen::Index i = 0; i < mesh.positions.rows(); ++i) {
    mesh.positions(i, 2) = 0.1 * std::cos(2 * mesh.positions(i, 0)) * std::cos(3 * mesh.positions(i, 1));
  }
  return {.mesh = std::make_shared<MeshMotion>(MeshMotion{.mesh = mesh})};
}

Cloth make_lying_cloth(int cells) {
  Cloth cloth = make_moving_cloth(cells);
  cloth.positions = cloth.rest;
  cloth.velocities.setZero();
  for (Eigen::Index i = 0; i < cloth.positions.rows(); ++i) {
    cloth.positions(i, 2) = 0.008 + 0.1 * std::cos(2 * cloth.positions(i, 0)) * std::cos(3 * cloth.positions(i, 1));
  }
  return cloth;
}

}  // namespace drape
