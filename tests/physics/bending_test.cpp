// Bending energies compared with a rolled sheet's, and effects of bending resistance on a cloth.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "drape/sim/effects/bending.hpp"
#include "drape/sim/simulation.hpp"
#include "sim/bending/bending_energy.hpp"
#include "sim/stability.hpp"
#include "sim/system.hpp"
#include "tests/support/meshes.hpp"
#include "tests/support/random.hpp"
#include "tests/support/setups.hpp"

namespace drape::test {
namespace {

constexpr double rigidity = 0.7;

/// Makes a flat sheet of n×n cells with inner vertices moved by up to a third of a cell and random diagonals.
Mesh uneven_grid(int n) {
  Mesh mesh = make_grid(n, n);
  mesh.uvs.clear();
  Random random(7);
  for (int j = 1; j < n; ++j) {
    for (int i = 1; i < n; ++i) {
      for (int axis = 0; axis < 2; ++axis) mesh.positions(j * (n + 1) + i, axis) += random.between(-0.5, 0.5) / n;
    }
  }
  const auto cells = static_cast<std::size_t>(n) * static_cast<std::size_t>(n);
  for (std::size_t cell = 0; cell < cells; ++cell) {
    if (random.number() < 0.5) continue;
    const auto [b, d, a] = mesh.triangles[cell];
    const int e = mesh.triangles[cells + cell][1];
    mesh.triangles[cell] = {a, b, e};
    mesh.triangles[cells + cell] = {a, e, d};
  }
  return mesh;
}

/// Rolls the plane onto a cylinder of radius R, whose axis is at an angle to the y axis.
Vertices rolled(const Vertices& flat, double radius, double angle) {
  Vertices x = flat;
  for (Eigen::Index i = 0; i < flat.rows(); ++i) {
    const double u = std::cos(angle) * flat(i, 0) + std::sin(angle) * flat(i, 1);
    const double v = -std::sin(angle) * flat(i, 0) + std::cos(angle) * flat(i, 1);
    x.row(i) << radius * std::sin(u / radius), v, radius * (1 - std::cos(u / radius));
  }
  return x;
}

double bending_energy(const Cloth& cloth, const Vertices& x) {
  Vertices ignored = Vertices::Zero(x.rows(), 3);
  return BendingEnergy(curvature_elements(cloth, rigidity), cloth.vertex_count()).add_gradient(x, 0, ignored);
}

/// Returns the energy of a sheet of 2 m × 2 m rolled to the radius: ½ D A/R².
double analytic_energy(double radius) { return 0.5 * rigidity * 4 / (radius * radius); }

struct Roll {
  const char* name;
  Mesh (*mesh)(int n);
  double degrees;
};

class RolledSheet : public testing::TestWithParam<Roll> {};
INSTANTIATE_TEST_SUITE_P(, RolledSheet,
                         testing::Values(Roll{"GridAlongX", [](int n) { return make_grid(n, n); }, 0},
                                         Roll{"GridAlongY", [](int n) { return make_grid(n, n); }, 90},
                                         Roll{"GridAlongItsDiagonals", [](int n) { return make_grid(n, n); }, -45},
                                         Roll{"GridAcrossItsDiagonals", [](int n) { return make_grid(n, n); }, 45},
                                         Roll{"UnevenAlongX", uneven_grid, 0}, Roll{"UnevenAlongY", uneven_grid, 90},
                                         Roll{"UnevenAskew", uneven_grid, 25}),
                         [](const auto& tested) { return tested.param.name; });

// The border, where a triangle has fewer hinges, is a share of 1/n of the sheet: the error halves with the cells, and
// Richardson extrapolation of that order removes it.
TEST_P(RolledSheet, HoldsTheAnalyticBendingEnergy) {
  const double angle = GetParam().degrees * std::numbers::pi / 180;
  for (const double radius : {0.8, 3.0}) {
    std::vector<double> ratios;
    for (const int n : {20, 40, 80}) {
      const Mesh mesh = GetParam().mesh(n);
      const Cloth cloth = cloth_of(mesh, 1, 1, {});
      ratios.push_back(bending_energy(cloth, rolled(mesh.positions, radius, angle)) / analytic_energy(radius));
      EXPECT_NEAR(ratios.back(), 1, 1.2 / n) << n << " cells, R = " << radius;
    }
    EXPECT_NEAR((ratios[2] - 1) / (ratios[1] - 1), 0.5, 0.05);
    EXPECT_NEAR(2 * ratios[2] - ratios[1], 1, 2e-3);
  }
}

TEST(BendingEnergy, IsZeroForEveryPlaceAndDirectionOfAFlatSheet) {
  const Mesh mesh = uneven_grid(15);
  const Cloth cloth = cloth_of(mesh, 1, 1, {});
  Eigen::Matrix3d turn;
  turn = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, -3).normalized());
  Vertices x = mesh.positions * turn.transpose();
  x.rowwise() += Eigen::RowVector3d(100, -50, 20);
  Vertices gradient = Vertices::Zero(x.rows(), 3);
  const double energy =
      BendingEnergy(curvature_elements(cloth, rigidity), cloth.vertex_count()).add_gradient(x, 0, gradient);
  EXPECT_NEAR(energy, 0, 1e-9 * analytic_energy(1));
  EXPECT_LT(gradient.cwiseAbs().maxCoeff(), 1e-9);
}

// A rolled rest shape has no energy, but only at its own radius.
TEST(BendingEnergy, IsZeroForARolledRestShape) {
  const Mesh flat = uneven_grid(20);
  Mesh mesh = flat;
  mesh.positions = rolled(flat.positions, 0.8, 0.4);
  const Cloth cloth = cloth_of(mesh, 1, 1, {});
  Vertices gradient = Vertices::Zero(mesh.positions.rows(), 3);
  const BendingEnergy energy(curvature_elements(cloth, rigidity), cloth.vertex_count());
  EXPECT_NEAR(energy.add_gradient(mesh.positions, 0, gradient), 0, 1e-9 * analytic_energy(0.8));
  EXPECT_LT(gradient.cwiseAbs().maxCoeff(), 1e-9);
}

// Unrolled half-way or completely, the curvature differs by half of 1/R or by 1/R; to the first order of the cell size,
// because of the border's triangles and the parts along a triangle that are flat again.
TEST(BendingEnergy, OfARolledRestShapeIsThatOfWhatItIsUnrolledBy) {
  constexpr double radius = 0.8, angle = 0.4;
  std::array<std::vector<double>, 2> ratios;
  for (const int n : {20, 40}) {
    const Mesh flat = uneven_grid(n);
    Mesh mesh = flat;
    mesh.positions = rolled(flat.positions, radius, angle);
    const Cloth cloth = cloth_of(mesh, 1, 1, {});
    ratios[0].push_back(bending_energy(cloth, rolled(flat.positions, 2 * radius, angle)) / analytic_energy(2 * radius));
    ratios[1].push_back(bending_energy(cloth, flat.positions) / analytic_energy(radius));
  }
  for (const auto& ratio : ratios) {
    EXPECT_NEAR(ratio[1], 1, 0.08);
    EXPECT_NEAR(2 * ratio[1] - ratio[0], 1, 0.03) << ratio[0] << ", " << ratio[1];
  }
}

TEST(CrossSprings, JoinTheVerticesOppositeToEveryInnerEdge) {
  // Two cells, vertices 0 1 2 above 3 4 5; their diagonals are 1–3 and 2–4.
  const Cloth cloth = cloth_of(make_grid(2, 1), 1, 1, {});
  const std::vector<Spring> springs = cross_springs(cloth, 5);
  ASSERT_EQ(springs.size(), 3U);
  const auto expect = [](const Spring& spring, int i, int j, double length) {
    EXPECT_EQ(spring.i, i);
    EXPECT_EQ(spring.j, j);
    EXPECT_DOUBLE_EQ(spring.rest_length, length);
    EXPECT_EQ(spring.stiffness, 5);
  };
  expect(springs[0], 0, 4, std::sqrt(5.0));  // across 1–3
  expect(springs[1], 1, 5, std::sqrt(5.0));  // across 2–4
  expect(springs[2], 2, 3, std::sqrt(8.0));  // across 1–4
}

TEST(CrossSprings, AreOneForEachInnerEdgeOfAGrid) {
  const int n = 7;
  EXPECT_EQ(cross_springs(cloth_of(make_grid(n, n), 1, 1, {}), 1).size(), static_cast<std::size_t>(3 * n * n - 2 * n));
}

TEST(Hinges, OfThreeSheetsAtAnEdgeAreTheirThreePairs) {
  const Cloth cloth = cloth_of(three_sheets(1), 1, 1, {});
  EXPECT_EQ(cross_springs(cloth, 1).size(), 3U + 3U);  // the shared edge's and the diagonals'
}

// Semi-implicit Euler evaluates the energy as a force, so its safe step must include bending.
TEST(SafeStep, IncludesBending) {
  SimulationSettings settings = setup(cloth_of(make_grid(20, 20), 1, 1e-3, {0, 20}), Method::semi_implicit, 1);
  settings.effects = {Bending{.rigidity = 1}};
  const double safe = safe_step(make_system(settings));
  const auto grows = [&](double step) {
    settings.step = step;
    settings.cloth.positions.col(2) = 1e-6 * random_vertices(settings.cloth.vertex_count(), 3).col(2);
    settings.integrator.allow_unstable = true;
    Simulation simulation(settings);
    const double before = simulation.energies().total();
    try {
      for (int i = 0; i < 1000; ++i) simulation.step();
    } catch (const DivergedError&) {
      EXPECT_GT(simulation.energies().total() / before, 0.9 * BlowUpWatch::limit_of_unstable_steps);
    }
    return simulation.energies().total() / before;
  };
  EXPECT_LT(grows(0.99 * safe), 1e3);
  EXPECT_GT(grows(1.01 * safe), 0.9 * BlowUpWatch::limit_of_unstable_steps);
}

class BentStrip : public testing::TestWithParam<NamedMethod> {};
INSTANTIATE_TEST_SUITE_P(With, BentStrip, testing::ValuesIn(all_methods), method_name);

// The free end of a clamped strip sags by ρ g L⁴/(8 D) if that is small: Euler and Bernoulli's beam.
TEST_P(BentStrip, SinksAsABeamDoes) {
  constexpr int columns = 24, rows = 3;
  constexpr double length = 1, width = 0.125, mass = 0.05, sag = 0.03, g = 9.8;
  Mesh mesh = make_grid(columns, rows);
  const double cell = length / (columns - 1);  // the first column of cells is in the clamp
  mesh.positions.col(0) = (mesh.positions.col(0).array() + 1) / 2 * columns * cell - cell;
  mesh.positions.col(1) *= width / 2;
  std::vector<int> clamp;
  for (int j = 0; j <= rows; ++j) {
    clamp.push_back(j * (columns + 1));
    clamp.push_back(j * (columns + 1) + 1);
  }
  SimulationSettings settings = setup(cloth_of(mesh, mass, 200, clamp), GetParam(), 0.01);
  settings.integrator.tolerance = 1e-7;
  settings.integrator.max_iterations = 2000;
  // The weight per metre of the strip; with lumped masses, those at the tip are as large as all others.
  const double load = g * mass / (columns + 1) / cell / width;
  const double bending = load * std::pow(length, 4) / (8 * sag);
  const double tip_load = g * mass / (columns + 1) / 2 / width;  // the tip's mass is too large by half a cell's
  const double expected = sag + tip_load * std::pow(length, 3) / (3 * bending);
  settings.effects = {Gravity{}, Bending{.rigidity = bending}, Damping{.factor = 1e-9}};
  if (GetParam().is_explicit()) settings.step = 0.95 * safe_step(make_system(settings));
  Simulation simulation(settings);
  StepReport last;
  while (simulation.time() < 2) last = simulation.step();
  EXPECT_TRUE(last.converged) << "at rest " << last.iterations << " iterations see nothing but rounding";
  const int tip = (rows + 1) / 2 * (columns + 1) + columns;
  EXPECT_LT(simulation.state().v.cwiseAbs().maxCoeff(), 1e-3) << "still moving";
  EXPECT_NEAR(-simulation.state().x(tip, 2), expected, 0.02 * expected);
}

// Without resistance the same strip hangs straight down.
TEST(BentStrip, WouldHangWithoutResistance) {
  Mesh mesh = make_grid(24, 3);
  mesh.positions.col(1) *= 0.06;
  std::vector<int> clamp;
  for (int j = 0; j <= 3; ++j) clamp.insert(clamp.end(), {j * 25, j * 25 + 1});
  SimulationSettings settings = setup(cloth_of(mesh, 0.05, 200, clamp), Method::implicit, 0.01);
  settings.effects = {Gravity{}, Damping{.factor = 0.01}};
  Simulation simulation(settings);
  while (simulation.time() < 4) simulation.step();
  EXPECT_LT(simulation.state().x(24, 2), -1.8);
}

}  // namespace
}  // namespace drape::test
