#include "bench/moving_cloth.hpp"

#include <algorithm>
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

}  // namespace drape
