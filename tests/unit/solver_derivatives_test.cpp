// Every energy, gradient and Hessian against finite differences.

#include <gtest/gtest.h>

#include "drape/sim/effects/bending.hpp"
#include "sim/linear/newton_cholesky.hpp"
#include "sim/linear/newton_solver.hpp"
#include "sim/step_objective.hpp"
#include "tests/support/cloths.hpp"

namespace drape {
namespace {

struct Case {
  const char* name;
  Cloth (*cloth)();  // every process lists all tests; only its own cloths are made
};
void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

Vertices wave(Eigen::Index rows, double frequency) {
  Vertices v(rows, 3);
  for (Eigen::Index i = 0; i < v.size(); ++i) v.data()[i] = std::sin(frequency * static_cast<double>(i + 1));
  return v;
}

class Derivatives : public ::testing::TestWithParam<Case> {
 protected:
  Derivatives() : cloth_(test::disturbed(GetParam().cloth())), system_(cloth_, 0.02) {
    Bending{.rigidity = 0.01}.install(system_);
    Vertices& x = cloth_.positions;
    x.col(2).array() -= 0.1;
    objective_ = std::make_unique<StepObjective>(system_, system_.step);
    objective_->begin(x, cloth_.velocities, Vertices::Zero(x.rows(), 3), system_.step);
    direction_ = wave(x.rows(), 1.7);
    for (const int pin : cloth_.pins) direction_.row(pin).setZero();
  }

  double value(const Vertices& x) const {
    Vertices ignored(x.rows(), 3);
    return objective_->evaluate(x, ignored);
  }
  Vertices gradient(const Vertices& x) const {
    Vertices result(x.rows(), 3);
    objective_->evaluate(x, result);
    return result;
  }

  Cloth cloth_;
  System system_;
  std::unique_ptr<StepObjective> objective_;
  Vertices direction_;
};

TEST_P(Derivatives, TheGradientIsTheSlopeOfTheValue) {
  const Vertices& x = cloth_.positions;
  const double e = 1e-6;
  const double slope = (value(x + e * direction_) - value(x - e * direction_)) / (2 * e);
  EXPECT_NEAR(dot(gradient(x), direction_), slope, 1e-6 * gradient(x).norm());
}

TEST_P(Derivatives, TheSphereAloneAgreesWithItsSlope) {
  // Its share of g would be negligible beside the springs'.
  Vertices x = cloth_.positions;
  x.col(2).array() -= 0.5;
  const Energy& energy = *system_.energies.front();
  const auto energy_at = [&](const Vertices& at, Vertices& g) {
    g.setZero(at.rows(), 3);
    return energy.add_gradient(at, 0, g);
  };
  Vertices g, ignored;
  ASSERT_GT(energy_at(x, g), 0) << "no vertex touches the sphere";
  const double e = 1e-6;
  const double slope = (energy_at(x + e * direction_, ignored) - energy_at(x - e * direction_, ignored)) / (2 * e);
  EXPECT_NEAR(g.cwiseProduct(direction_).sum(), slope, 1e-6 * g.norm());
}

// If every spring is stretched, the Hessian is complete.
TEST_P(Derivatives, TheHessianOfStretchedClothIsTheSlopeOfTheGradient) {
  const Vertices x = 5 * cloth_.positions;
  const SpringNetwork& springs = objective_->springs();
  for (const Spring& s : springs.springs()) ASSERT_GT((x.row(s.i) - x.row(s.j)).norm(), s.rest_length);
  SpringNetwork::Blocks blocks;
  springs.compute_blocks(x, 0, blocks);
  Vertices product = Vertices::Zero(x.rows(), 3), above = product, below = product;
  springs.add_product(blocks, direction_, product);
  const double e = 1e-6;
  springs.add_value_gradient(x + e * direction_, above);
  springs.add_value_gradient(x - e * direction_, below);
  EXPECT_LT((product - (above - below) / (2 * e)).norm(), 1e-6 * product.norm());
}

TEST_P(Derivatives, BothLinearSolversSolveTheSameEquations) {
  const Vertices& x = cloth_.positions;
  const Vertices g = gradient(x);
  Vertices exact(x.rows(), 3), iterated(x.rows(), 3);
  NewtonCholesky(system_, *objective_).solve(x, g, 0, exact);
  ConjugateGradients(system_, *objective_).solve(x, g, 0, iterated);
  // To the tolerance of the inner iteration in the norm of forces; division by the smallest eigenvalue m/h² gives
  // lengths.
  const double smallest = objective_->inertia().minCoeff();
  EXPECT_LT((exact - iterated).norm(), 1.1e-2 * g.norm() / smallest);
  for (const int pin : cloth_.pins) {
    EXPECT_EQ(exact.row(pin).norm(), 0);
    EXPECT_EQ(iterated.row(pin).norm(), 0);
  }
}

INSTANTIATE_TEST_SUITE_P(, Derivatives,
                         ::testing::Values(Case{"grid", [] { return test::grid_cloth(20); }},
                                           Case{"wide_grid", [] { return test::grid_cloth(70); }},
                                           Case{"irregular", [] { return test::irregular_cloth(); }},
                                           Case{"non_manifold", [] { return test::non_manifold_cloth(); }}),
                         [](const auto& tested) { return tested.param.name; });

TEST(SpringKernels, ASpringOfZeroLengthPullsNowhere) {
  Cloth cloth = test::grid_cloth(4);
  cloth.positions.setZero();
  const SpringNetwork springs(cloth.springs, cloth.vertex_count());
  Vertices gradient = Vertices::Zero(cloth.positions.rows(), 3);
  const double energy = springs.add_value_gradient(cloth.positions, gradient);
  EXPECT_EQ(gradient, Vertices::Zero(cloth.positions.rows(), 3));
  double expected = 0;
  for (const Spring& s : cloth.springs) expected += 0.5 * s.stiffness * s.rest_length * s.rest_length;
  EXPECT_NEAR(energy, expected, 1e-12 * expected);
}

}  // namespace
}  // namespace drape
