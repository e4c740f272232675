// Every minimised energy, compared with finite differences and its own bounds.

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <functional>
#include <ostream>
#include <string>

#include "drape/sim/effects/bending.hpp"
#include "drape/sim/effects/damping.hpp"
#include "drape/sim/effects/ground.hpp"
#include "sim/dashpots.hpp"
#include "sim/linear/newton_cholesky.hpp"
#include "sim/linear/newton_solver.hpp"
#include "sim/step_objective.hpp"
#include "tests/support/meshes.hpp"
#include "tests/support/random.hpp"
#include "tests/support/setups.hpp"

namespace drape::test {
namespace {

/// Effects with energies, on a cloth that they act on.
struct Case {
  std::string name;
  std::function<Mesh()> mesh;
  Effects effects;
};
void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

Mesh flat_mesh() { return make_grid(9, 7); }
Mesh bowl() {
  Mesh mesh = irregular_mesh(9);
  mesh.positions.col(2) += 0.4 * mesh.positions.leftCols(2).rowwise().squaredNorm();
  return mesh;
}
const Bending bending{.rigidity = 0.3};

Effects damping() { return {InternalDamping{.relaxation_time = 0.03}}; }
Effects bending_and_damping() { return {bending, InternalDamping{.relaxation_time = 0.03}}; }

/// The energies of effects, together with the dissipation potentials of a step.
class Term {
 public:
  Term(const Mesh& mesh, const Effects& effects) : cloth_(cloth_of(mesh, 1, 180, {0, 3})), system_(cloth_, 0.02) {
    for (const Effect& effect : effects) effect.install(system_);
    for (const auto& dashpots : system_.dashpots) {
      auto dissipation = std::make_unique<StepDissipation>(dashpots, system_.step, cloth_.positions);
      dissipation->begin(cloth_.positions + 0.1 * random_vertices(cloth_.vertex_count(), 7), cloth_.positions,
                         1.5 * system_.step);
      system_.energies.push_back(std::move(dissipation));
    }
    for (const auto& energy : system_.energies) hessians_.push_back(energy->make_hessian());
  }

  [[nodiscard]] const Cloth& cloth() const { return cloth_; }
  [[nodiscard]] const System& system() const { return system_; }

  double value(const Vertices& x) const {
    Vertices ignored = Vertices::Zero(x.rows(), 3);
    return add_gradient(x, ignored);
  }
  Vertices gradient(const Vertices& x) const {
    Vertices result = Vertices::Zero(x.rows(), 3);
    add_gradient(x, result);
    return result;
  }
  /// Returns H(x)·v.
  Vertices product(const Vertices& x, const Vertices& v) {
    Vertices result = Vertices::Zero(x.rows(), 3);
    for (const auto& hessian : hessians_) {
      hessian->linearise(x, 0, 0);
      hessian->add_product(v, result);
    }
    return result;
  }
  /// Returns H(x)·v by the blocks, for an energy of independent vertices.
  Vertices product_of_blocks(const Vertices& x, const Vertices& v) {
    HessianBlocks blocks{.pairs = {}, .vertices = Eigen::Matrix<double, Eigen::Dynamic, 6>::Zero(x.rows(), 6)};
    for (const auto& hessian : hessians_) {
      hessian->linearise(x, 0, 0);
      hessian->add_blocks(blocks);
    }
    Vertices result(x.rows(), 3);
    for (Eigen::Index i = 0; i < x.rows(); ++i) {
      const auto b = blocks.vertices.row(i);
      Eigen::Matrix3d block;
      block << b[0], b[1], b[2], b[1], b[3], b[4], b[2], b[4], b[5];
      result.row(i) = v.row(i) * block;
    }
    return result;
  }
  /// Returns vᵀ B v of the constant bound B.
  double bounded(const Vertices& v) const {
    StiffnessBound bound{.vertices = Eigen::VectorXd::Zero(v.rows())};
    for (const auto& energy : system_.energies) energy->add_bound(bound);
    double sum = bound.vertices.dot(v.rowwise().squaredNorm());
    for (const Spring& s : bound.pairs) sum += s.stiffness * (v.row(s.i) - v.row(s.j)).squaredNorm();
    return sum;
  }

 private:
  double add_gradient(const Vertices& x, Vertices& gradient) const {
    double value = 0;
    for (const auto& energy : system_.energies) value += energy->add_gradient(x, 0, gradient);
    return value;
  }

  Cloth cloth_;
  System system_;
  std::vector<std::unique_ptr<EnergyHessian>> hessians_;
};

double product(const Vertices& a, const Vertices& b) { return a.cwiseProduct(b).sum(); }

class EveryEnergy : public testing::TestWithParam<Case> {
 protected:
  EveryEnergy() : term_(GetParam().mesh(), GetParam().effects) {}

  /// Returns the cloth randomly displaced by up to `by` metres.
  Vertices crumpled(double by, int seed) const {
    return term_.cloth().positions + by * random_vertices(term_.cloth().vertex_count(), seed);
  }
  Vertices direction(int seed) const { return random_vertices(term_.cloth().vertex_count(), seed); }

  Term term_;
};
INSTANTIATE_TEST_SUITE_P(, EveryEnergy,
                         testing::Values(Case{"BendingFromFlat", flat_mesh, {bending}},
                                         Case{"BendingFromABowl", bowl, {bending}},
                                         Case{"BendingOfThreeSheets", [] { return three_sheets(4); }, {bending}},
                                         Case{"DashpotsOfAGrid", flat_mesh, damping()},
                                         Case{"DashpotsOfABowl", bowl, bending_and_damping()}),
                         [](const auto& tested) { return tested.param.name; });

TEST_P(EveryEnergy, HasTheSlopeItsGradientSays) {
  constexpr double e = 1e-5;
  for (const int seed : {1, 2, 3}) {
    const Vertices x = crumpled(0.1, seed), d = direction(seed + 10);
    ASSERT_GT(term_.value(x), 0);
    const double slope = (term_.value(x + e * d) - term_.value(x - e * d)) / (2 * e);
    EXPECT_NEAR(product(term_.gradient(x), d), slope, 1e-6 * term_.gradient(x).norm());
  }
}

TEST_P(EveryEnergy, IsNeverNegative) {
  EXPECT_GE(term_.value(term_.cloth().positions), -1e-12);
  for (const int seed : {1, 2, 3}) EXPECT_GE(term_.value(crumpled(0.5, seed)), 0);
}

// The Hessian is the slope of the gradient, or larger if negative eigenvalues were left out.
TEST_P(EveryEnergy, HasTheCurvatureItsHessianSaysOrLess) {
  constexpr double e = 1e-6;
  for (const int seed : {1, 2, 3}) {
    const Vertices x = crumpled(0.1, seed), d = direction(seed + 10);
    const double slope = product(term_.gradient(x + e * d) - term_.gradient(x - e * d), d) / (2 * e);
    const double curvature = product(term_.product(x, d), d);
    EXPECT_GE(curvature, slope - 1e-5 * term_.bounded(d));
    EXPECT_GE(curvature, 0);
    EXPECT_LE(curvature, term_.bounded(d) * (1 + 1e-12));
  }
}

// The bound that spares Liu13 a line search: E(x + d) ≤ E(x) + ∇E·d + ½ dᵀBd for any d.
TEST_P(EveryEnergy, StaysBelowTheParabolaOfItsBound) {
  for (const int seed : {1, 2, 3}) {
    for (const double far : {1e-2, 0.3, 5.0}) {
      const Vertices x = crumpled(0.1, seed), d = far * direction(seed + 10);
      const double parabola = term_.value(x) + product(term_.gradient(x), d) + 0.5 * term_.bounded(d);
      EXPECT_LE(term_.value(x + d), parabola * (1 + 1e-12));
    }
  }
}

TEST_P(EveryEnergy, PullsNowhereAsAWhole) {
  const Vertices x = crumpled(0.1, 1), g = term_.gradient(x);
  EXPECT_LT(g.colwise().sum().norm(), 1e-12 * g.norm() * std::sqrt(static_cast<double>(g.rows())));
}

// M/h² p + (springs and energy) p = b, with the assembled matrix and with products alone.
TEST_P(EveryEnergy, EntersBothOfNewtonsLinearSolvers) {
  const System& system = term_.system();
  const StepObjective objective(system, system.step);
  const Vertices x = crumpled(0.1, 1);
  Vertices b = direction(5);
  for (const int pin : term_.cloth().pins) b.row(pin).setZero();
  const auto residual = [&](const Vertices& p) {
    SpringNetwork::Blocks blocks;
    objective.springs().compute_blocks(x, 0, blocks);
    Vertices left = objective.inertia().asDiagonal() * p + term_.product(x, p);
    objective.springs().add_product(blocks, p, left);
    for (const int pin : term_.cloth().pins) left.row(pin).setZero();
    return (left - b).norm() / b.norm();
  };
  Vertices p(x.rows(), 3);
  NewtonCholesky(system, objective).solve(x, b, 0, p);
  EXPECT_LT(residual(p), 1e-10);
  ConjugateGradients(system, objective).solve(x, b, 0, p);
  EXPECT_LT(residual(p), 1.01e-2);
}

}  // namespace
}  // namespace drape::test
