// Cusick's drape test: a disc of 30 cm on a support of 18 cm. The part of the ring beyond the support that the shadow
// covers depends on the fabric, not on the mesh.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "drape/sim/cloth.hpp"
#include "drape/sim/effects/bending.hpp"
#include "drape/sim/simulation.hpp"
#include "tests/support/cloths.hpp"
#include "tests/support/random.hpp"
#include "tests/support/setups.hpp"

namespace drape::drape_coefficient_test {
namespace {

constexpr double support = 0.09, edge = 0.15;  // radii [m]

/// Returns the number of the first vertex of a ring: the k-th has 6k vertices, and ring 0 is the centre.
int first_of(int ring) { return ring == 0 ? 0 : 1 + 3 * ring * (ring - 1); }

/// Makes a disc of rings at multiples of `cell`, with nearly equilateral triangles.
Mesh disc(double cell) {
  const int rings = static_cast<int>(std::lround(edge / cell));
  Mesh mesh;
  mesh.positions.setZero(first_of(rings + 1), 3);
  for (int k = 1; k <= rings; ++k) {
    for (int i = 0; i < 6 * k; ++i) {
      const double angle = 2 * std::numbers::pi * i / (6 * k);
      mesh.positions.row(first_of(k) + i) << k * cell * std::cos(angle), k * cell * std::sin(angle), 0;
    }
    for (int sector = 0; sector < 6; ++sector) {
      for (int i = 0; i < k; ++i) {
        const auto outer = [&](int j) { return first_of(k) + (sector * k + j) % (6 * k); };
        const auto inner = [&](int j) { return k == 1 ? 0 : first_of(k - 1) + (sector * (k - 1) + j) % (6 * (k - 1)); };
        mesh.triangles.push_back({outer(i), outer(i + 1), inner(i)});
        if (i + 1 < k) mesh.triangles.push_back({inner(i), outer(i + 1), inner(i + 1)});
      }
    }
  }
  return mesh;
}

/// Returns the area of a cloth's shadow from above, in squares of half a millimetre [m²].
double shadow(const Cloth& cloth, const Vertices& x) {
  constexpr double pixel = 5e-4;
  constexpr int size = 2 * 320;
  std::vector<char> covered(std::size_t{size} * size, 0);
  const auto cross = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); };
  for (const Triangle& t : cloth.triangles) {
    Eigen::Matrix<double, 3, 2> p;  // [pixels]
    for (int k = 0; k < 3; ++k) p.row(k) = x.row(t[static_cast<std::size_t>(k)]).leftCols(2).array() / pixel + size / 2;
    const Eigen::RowVector2d low = p.colwise().minCoeff(), high = p.colwise().maxCoeff();
    for (int j = std::max(0, int(low[1])); j <= std::min(size - 1, int(high[1])); ++j) {
      for (int i = std::max(0, int(low[0])); i <= std::min(size - 1, int(high[0])); ++i) {
        const Eigen::Vector2d q(i + 0.5, j + 0.5);
        double least = 1e9, most = -1e9;
        for (int k = 0; k < 3; ++k) {
          const Eigen::Vector2d a = p.row(k), b = p.row((k + 1) % 3);
          const double side = cross(b - a, q - a);
          least = std::min(least, side);
          most = std::max(most, side);
        }
        if (least >= 0 || most <= 0) covered[std::size_t(j) * size + std::size_t(i)] = 1;
      }
    }
  }
  return static_cast<double>(std::ranges::count(covered, 1)) * pixel * pixel;
}

/// Returns the fraction of the ring beyond the support that a fabric's shadow covers at rest.
double drape_coefficient(const Fabric& fabric, double cell, int seed) {
  const Mesh flat = disc(cell);
  std::vector<int> held;
  for (int i = 0; i < flat.positions.rows(); ++i) {
    if (flat.positions.row(i).norm() < support + cell / 10) held.push_back(i);
  }
  Cloth cloth = test::cloth_of(flat, 1, 1, held);
  share_mass_by_area(fabric.density, cloth);
  stiffen_by_direction(fabric.modulus, cloth);
  // Perturbed like a real disc: a wave of every number of folds, of a tenth of a millimetre.
  test::Random random(static_cast<std::uint64_t>(seed));
  std::vector<double> phases;
  for (int n = 0; n < 12; ++n) phases.push_back(random.between(0, 2 * std::numbers::pi));
  for (int i = 0; i < cloth.vertex_count(); ++i) {
    const double x = flat.positions(i, 0), y = flat.positions(i, 1), beyond = std::hypot(x, y) - support;
    if (beyond <= cell / 10) continue;
    for (int n = 0; n < 12; ++n) {
      cloth.positions(i, 2) +=
          1e-4 * beyond / (edge - support) * std::sin(n * std::atan2(y, x) + phases[std::size_t(n)]);
    }
  }
  SimulationSettings settings = test::setup(std::move(cloth), Method::quasi_newton, 0.01);
  settings.integrator.tolerance.reset();
  settings.effects = {Gravity{}, Bending{.rigidity = fabric.rigidity}, Damping{.factor = 0.05}};
  Simulation simulation(settings);
  const auto speed = [&] { return simulation.state().v.rowwise().norm().maxCoeff(); };
  while (simulation.time() < 1 || (simulation.time() < 20 && speed() > 0.005)) simulation.step();
  EXPECT_LE(speed(), 0.005) << "still moving";
  const double inside = std::numbers::pi * support * support, whole = std::numbers::pi * edge * edge;
  return (shadow(settings.cloth, simulation.state().x) - inside) / (whole - inside);
}

class DrapeCoefficient : public testing::TestWithParam<std::string_view> {};
INSTANTIATE_TEST_SUITE_P(Nightly, DrapeCoefficient, testing::Values("denim", "interlock", "ponte-roma"));

TEST_P(DrapeCoefficient, DoesNotDependOnTheCells) {
  std::vector<double> means;
  for (const double cell : {0.01, 0.0075, 0.005}) {
    double sum = 0;
    for (const int seed : {1, 2, 3}) sum += drape_coefficient(test::fabric(GetParam()), cell, seed);
    means.push_back(sum / 3);
  }
  const auto [least, most] = std::ranges::minmax(means);
  EXPECT_LT(most - least, 0.03) << testing::PrintToString(means);
  EXPECT_GT(least, 0.05);
  EXPECT_LT(most, 0.95);
}

}  // namespace
}  // namespace drape::drape_coefficient_test
