// The energy of an enclosed gas, compared with finite differences, its bounds and the volumes of known bodies.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <ostream>
#include <stdexcept>
#include <string>
#include <utility>

#include "drape/sim/effects/pressure.hpp"
#include "sim/linear/newton_cholesky.hpp"
#include "sim/linear/newton_solver.hpp"
#include "sim/pressure/gas_energy.hpp"
#include "sim/step_objective.hpp"
#include "tests/support/closed_meshes.hpp"
#include "tests/support/meshes.hpp"
#include "tests/support/random.hpp"
#include "tests/support/setups.hpp"

namespace drape::test {
namespace {

double gas_product(const Vertices& a, const Vertices& b) { return a.cwiseProduct(b).sum(); }

/// Makes two balls of different sizes, far from the origin; the second is turned inside out.
Mesh two_balls() {
  Mesh mesh = ball(4, 0.3), other = ball(3, 0.2);
  const auto first = static_cast<int>(mesh.positions.rows());
  mesh.positions.conservativeResize(first + other.positions.rows(), 3);
  mesh.positions.bottomRows(other.positions.rows()) = other.positions;
  mesh.positions.bottomRows(other.positions.rows()).col(0).array() += 1;
  for (const auto& [a, b, c] : other.triangles) mesh.triangles.push_back({first + a, first + c, first + b});
  mesh.positions.rowwise() += Eigen::RowVector3d(10, -20, 5);
  return mesh;
}

struct GasCase {
  std::string name;
  Mesh mesh;
  Pressure effect;
};
void PrintTo(const GasCase& c, std::ostream* out) { *out << c.name; }

class EveryGas : public testing::TestWithParam<GasCase> {
 protected:
  EveryGas() : cloth_(cloth_of(GetParam().mesh, 1, 180, {0, 3})), system_(cloth_, 0.02) {
    GetParam().effect.install(system_);
    hessian_ = energy().make_hessian();
  }

  const GasEnergy& energy() const { return dynamic_cast<const GasEnergy&>(*system_.energies.front()); }
  double value(const Vertices& x) const {
    Vertices ignored = Vertices::Zero(x.rows(), 3);
    return energy().add_gradient(x, 0, ignored);
  }
  Vertices gradient(const Vertices& x) const {
    Vertices result = Vertices::Zero(x.rows(), 3);
    energy().add_gradient(x, 0, result);
    return result;
  }
  Vertices product_at(const Vertices& x, double concavity, const Vertices& v) const {
    Vertices result = Vertices::Zero(x.rows(), 3);
    hessian_->linearise(x, 0, concavity);
    hessian_->add_product(v, result);
    return result;
  }
  double bounded(const Vertices& v) const {
    StiffnessBound bound{.vertices = Eigen::VectorXd::Zero(v.rows())};
    energy().add_bound(bound);
    double sum = 0;
    for (const Spring& s : bound.pairs) sum += s.stiffness * (v.row(s.i) - v.row(s.j)).squaredNorm();
    return sum;
  }
  /// Returns the cloth with every coordinate displaced by up to `by` metres.
  Vertices crumpled(double by, int seed) const { return cloth_.positions + by * direction(seed); }
  Vertices direction(int seed) const { return random_vertices(cloth_.vertex_count(), seed); }

  Cloth cloth_;
  System system_;
  std::unique_ptr<EnergyHessian> hessian_;
};
INSTANTIATE_TEST_SUITE_P(
    , EveryGas,
    testing::Values(GasCase{"Constant", two_balls(), {.pressure = 300}},
                    GasCase{"ConstantInALens", two_discs(5, 0.1), {.pressure = 300}},
                    GasCase{"Ideal", two_balls(), {.pressure = 300, .gas = Gas::ideal}},
                    GasCase{"IdealInAVacuum", two_balls(), {.pressure = 300, .gas = Gas::ideal, .ambient = 0}}),
    [](const auto& tested) { return tested.param.name; });

TEST_P(EveryGas, HasTheSlopeItsGradientSays) {
  constexpr double e = 1e-5;
  for (const int seed : {1, 2, 3}) {
    const Vertices x = crumpled(0.01, seed), d = direction(seed + 10);
    const double slope = (value(x + e * d) - value(x - e * d)) / (2 * e);
    EXPECT_NEAR(gas_product(gradient(x), d), slope, 1e-6 * gradient(x).norm());
  }
}

TEST_P(EveryGas, IsNeverNegative) {
  EXPECT_GE(value(cloth_.positions), 0);
  for (const int seed : {1, 2, 3}) EXPECT_GE(value(crumpled(0.05, seed)), 0);
}

TEST_P(EveryGas, HasTheCurvatureItsHessianSays) {
  constexpr double e = 1e-6;
  for (const int seed : {1, 2, 3}) {
    const Vertices x = crumpled(0.01, seed), d = direction(seed + 10);
    const Vertices slope = (gradient(x + e * d) - gradient(x - e * d)) / (2 * e);
    EXPECT_LT((product_at(x, 1, d) - slope).norm(), 1e-6 * slope.norm());
  }
}

// Random directions are spread over all frequencies; the shape itself and its normals are the smooth ones.
TEST_P(EveryGas, LeavesOutNegativeCurvatureOnlyAndStaysBelowItsBound) {
  const Vertices x = crumpled(0.005, 4);
  Vertices outwards = x;
  outwards.rowwise() -= x.colwise().mean();
  for (const Vertices& d : {direction(1), direction(2), outwards, Vertices(gradient(x))}) {
    const double positive = gas_product(product_at(x, 0, d), d), exact = gas_product(product_at(x, 1, d), d);
    EXPECT_GE(positive, 0);
    EXPECT_GE(positive, exact - 1e-12 * bounded(d));
    EXPECT_LE(positive, bounded(d) * (1 + 1e-12));
    EXPECT_GE(exact, -bounded(d) * (1 + 1e-12));
  }
}

TEST_P(EveryGas, ResistsNoTranslation) {
  const Vertices x = crumpled(0.01, 1);
  const Vertices along = Eigen::VectorXd::Ones(x.rows()) * Eigen::RowVector3d(1, 2, -3);
  for (const double concavity : {0.0, 0.5, 1.0}) {
    EXPECT_LT(product_at(x, concavity, along).norm(), 1e-9 * product_at(x, concavity, direction(1)).norm());
  }
}

// Momentum: forces without a sum and without a moment, also far from the origin.
TEST_P(EveryGas, PushesAndTurnsNothingAsAWhole) {
  const Vertices x = crumpled(0.02, 1), g = gradient(x);
  Eigen::RowVector3d moment = Eigen::RowVector3d::Zero();
  for (Eigen::Index i = 0; i < x.rows(); ++i) moment += x.row(i).cross(g.row(i));
  EXPECT_LT(g.colwise().sum().norm(), 1e-13 * g.norm() * std::sqrt(static_cast<double>(g.rows())));
  EXPECT_LT(moment.norm(), 1e-13 * g.norm() * x.norm());
}

TEST_P(EveryGas, EntersBothOfNewtonsLinearSolvers) {
  const StepObjective objective(system_, system_.step);
  const Vertices x = crumpled(0.005, 1);
  Vertices b = direction(5);
  for (const int pin : cloth_.pins) b.row(pin).setZero();
  const auto residual = [&](const Vertices& p) {
    SpringNetwork::Blocks blocks;
    objective.springs().compute_blocks(x, 0, blocks);
    Vertices left = objective.inertia().asDiagonal() * p + product_at(x, 0, p);
    objective.springs().add_product(blocks, p, left);
    for (const int pin : cloth_.pins) left.row(pin).setZero();
    return (left - b).norm() / b.norm();
  };
  Vertices p(x.rows(), 3);
  NewtonCholesky(system_, objective).solve(x, b, 0, p);
  EXPECT_LT(residual(p), 1e-9);
  ConjugateGradients(system_, objective).solve(x, b, 0, p);
  EXPECT_LT(residual(p), 1.01e-2);
}

TEST(GasLaw, KeepsPressureTimesVolume) {
  const GasLaw law = GasLaw::ideal(500, 1e5, 0.02, 1);
  for (const double volume : {0.005, 0.02, 0.3}) EXPECT_NEAR((law.pressure(volume) + 1e5) * volume, 2010, 1e-9);
  EXPECT_NEAR(law.pressure(0.02), 500, 1e-9);
  EXPECT_NEAR(GasLaw::constant(500, 1).pressure(0.3), 500, 0);
}

TEST(GasLaw, HasNoPressureAtItsLeastEnergyAndNoEnergyThere) {
  const GasLaw law = GasLaw::ideal(500, 1e5, 0.02, 1);
  EXPECT_NEAR(law.pressure(0.0201), 0, 1e-9);
  EXPECT_NEAR(law.energy(0.0201), 0, 1e-12);
  EXPECT_EQ(law.energy(-0.01), std::numeric_limits<double>::infinity());
  EXPECT_EQ(law.energy(1.01), std::numeric_limits<double>::infinity());
}

TEST(ClosedPieces, EncloseTheVolumesOfTheirBodies) {
  const Mesh fine = ball(40, 0.3);
  EXPECT_NEAR(enclosed_volume(fine.triangles, fine.positions), 4.0 / 3 * std::numbers::pi * 0.027, 2e-4);
  EXPECT_NEAR(surface_area(fine.triangles, fine.positions), 4 * std::numbers::pi * 0.09, 1e-3);
  const Mesh octahedron = ball(1, 2);
  EXPECT_NEAR(enclosed_volume(octahedron.triangles, octahedron.positions), 32.0 / 3, 1e-12);
}

TEST(ClosedPieces, FaceOutwardsHoweverTheirTrianglesAreWound) {
  Mesh mesh = two_balls();
  Random random(3);
  for (Triangle& t : mesh.triangles) {
    if (random.number() < 0.5) std::swap(t[0], t[1]);
  }
  const auto pieces = closed_pieces(cloth_of(mesh, 1, 1, {}));
  ASSERT_EQ(pieces.size(), 2U);
  EXPECT_NEAR(enclosed_volume(pieces[0].triangles, mesh.positions),
              enclosed_volume(ball(4, 0.3).triangles, ball(4, 0.3).positions), 1e-12);
  EXPECT_NEAR(enclosed_volume(pieces[1].triangles, mesh.positions),
              enclosed_volume(ball(3, 0.2).triangles, ball(3, 0.2).positions), 1e-12);
}

TEST(ClosedPieces, OfAFlatMeshKeepTheirFronts) {
  const Mesh mesh = two_discs(3, 0);
  const auto pieces = closed_pieces(cloth_of(mesh, 1, 1, {}));
  ASSERT_EQ(pieces.size(), 1U);
  EXPECT_EQ(pieces[0].triangles, mesh.triangles);
}

/// Returns the sentence of the exception, or nothing.
std::string refused(const Mesh& mesh) {
  try {
    closed_pieces(cloth_of(mesh, 1, 1, {}));
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(ClosedPieces, RefuseOpenAndOneSidedMeshesByAnEdge) {
  EXPECT_EQ(refused(make_grid(1, 1)),
            "expected closed pieces, where every edge has two triangles, but the edge of vertices 0 and 1 has 1");
  EXPECT_NE(refused(three_sheets(2)), "");
  // The projective plane with six vertices: half of an icosahedron.
  Mesh projective;
  projective.positions = random_vertices(6, 1);
  projective.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}, {0, 5, 1},
                          {1, 2, 4}, {2, 3, 5}, {3, 4, 1}, {4, 5, 2}, {5, 1, 3}};
  EXPECT_NE(refused(projective).find("has only one side"), std::string::npos) << refused(projective);
}

TEST(PressureEffect, ReportsEveryProblemOfItsTable) {
  const auto found = [](const Mesh& mesh, const Pressure& effect) {
    return problems(effect, setup(cloth_of(mesh, 1, 1, {}), Method::implicit, 0.01));
  };
  EXPECT_TRUE(found(ball(2, 1), {.pressure = 10, .gas = Gas::ideal}).empty());
  EXPECT_TRUE(found(two_discs(2, 0), {.pressure = 10}).empty());
  EXPECT_EQ(found(make_grid(2, 2), {.pressure = 10}).size(), 1U);
  ASSERT_EQ(found(two_discs(2, 0), {.pressure = 10, .gas = Gas::ideal}).size(), 1U);
  EXPECT_EQ(found(two_discs(2, 0), {.pressure = 10, .gas = Gas::ideal}).front().substr(0, 4), "gas:");
  EXPECT_EQ(found(ball(2, 1), {.gas = Gas::ideal, .ambient = 0}).size(), 1U);
}

}  // namespace
}  // namespace drape::test
