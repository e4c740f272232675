#include "bench/moving_cloth.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

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

Cloth make_pillow(int cells) {
  Mesh mesh = make_grid(cells, cells);
  const Eigen::Index upper = mesh.positions.rows();
  std::vector<int> lower(static_cast<std::size_t>(upper));
  int count = static_cast<int>(upper);
  for (Eigen::Index i = 0; i < upper; ++i) {
    const double x = mesh.positions(i, 0), y = mesh.positions(i, 1);
    const bool border = std::max(std::abs(x), std::abs(y)) > 1 - 1e-9;
    lower[static_cast<std::size_t>(i)] = border ? static_cast<int>(i) : count++;
    mesh.positions(i, 2) = 0.1 * (1 - x * x) * (1 - y * y);
  }
  mesh.positions.conservativeResize(count, 3);
  for (Eigen::Index i = 0; i < upper; ++i) {
    const auto below = lower[static_cast<std::size_t>(i)];
    if (below != i) mesh.positions.row(below) = mesh.positions.row(i).cwiseProduct(Eigen::RowVector3d(1, 1, -1));
  }
  const auto vertex = [&](int v) { return lower[static_cast<std::size_t>(v)]; };
  for (const Triangle& t : std::vector(mesh.triangles)) {
    mesh.triangles.push_back({vertex(t[0]), vertex(t[2]), vertex(t[1])});
  }
  return make_cloth(mesh, mesh, 1.0, stiffness, {});
}

Cloth make_sewn_cloth(int cells) {
  Mesh half = make_grid(cells / 2, cells);
  half.positions.col(0) *= 0.5;
  Cloth all;
  for (const double side : {-0.5, 0.5}) {
    Mesh placed = half;
    placed.positions.col(0).array() += side;
    append(side < 0 ? "left" : "right", make_cloth(placed, placed, 0.5, stiffness, {}), all);
  }
  const int columns = cells / 2 + 1, right = columns * (cells + 1);
  Seam seam;
  for (int j = 0; j <= cells; ++j) {
    const int a = j * columns + columns - 1, b = right + j * columns;
    seam.ties.push_back({.vertex = a, .edge = {b, b}});
    seam.sides[0].push_back(a);
    seam.sides[1].push_back(b);
  }
  all.seams.push_back(std::move(seam));
  return all;
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
