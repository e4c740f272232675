#include "bench/moving_cloth.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>

#include "bench/textbook.hpp"

namespace drape {
namespace {

constexpr int coarse_cells = 20;
constexpr double stiffness = 180;  // [N/m]

/// Interpolates vertex values of the coarse grid bilinearly onto a grid of cells×cells.
Vertices interpolate(const Eigen::MatrixXd& coarse, int cells) {
  const int stride = coarse_cells + 1, scale = cells / coarse_cells;
  Vertices fine((cells + 1) * (cells + 1), 3);
  for (int j = 0, vertex = 0; j <= cells; ++j) {
    for (int i = 0; i <= cells; ++i, ++vertex) {
      const int left = std::min(i / scale, coarse_cells - 1), below = std::min(j / scale, coarse_cells - 1);
      const double u = static_cast<double>(i) / scale - left, v = static_cast<double>(j) / scale - below;
      const int corner = below * stride + left;
      fine.row(vertex) = (1 - v) * ((1 - u) * coarse.row(corner) + u * coarse.row(corner + 1)) +
                         v * ((1 - u) * coarse.row(corner + stride) + u * coarse.row(corner + stride + 1));
    }
  }
  return fine;
}

}  // namespace

Cloth make_resting_cloth(int cells) {
  const Mesh grid = make_grid(cells, cells);
  return make_cloth(grid, grid, 1.0, stiffness, {0, cells});
}

Cloth make_moving_cloth(int cells) {
  if (cells < coarse_cells || cells % coarse_cells != 0) throw std::invalid_argument("cells must be a multiple of 20");
  static const std::unique_ptr<textbook::Stepper> coarse = [] {
    auto stepper = textbook::make_newton(make_resting_cloth(coarse_cells), {});
    for (int step = 0; step < 50; ++step) stepper->step();
    return stepper;
  }();
  Cloth cloth = make_resting_cloth(cells);
  cloth.positions = interpolate(coarse->positions, cells);
  cloth.velocities = interpolate(coarse->velocities, cells);
  return cloth;
}

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
