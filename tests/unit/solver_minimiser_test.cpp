// Common parts of the minimisers: the line search, rounding of g, L-BFGS directions.

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <vector>

#include "sim/solvers/minimiser.hpp"
#include "sim/solvers/quasi_newton.hpp"
#include "tests/support/cloths.hpp"
#include "tests/support/setups.hpp"

namespace drape::test {
namespace {

/// A minimiser with prescribed moves.
class Told final : public Minimiser {
 public:
  Told(const System& system, const StepObjective& objective) : Minimiser(system, objective, {}, 1) {}
  using Minimiser::descend;

 private:
  double iterate(Iterate&) override { return 0; }
  void find_newton_step(const Iterate&, Vertices&) override {}
};

// Without springs g is a parabola about y. Along t(x − y) a move of length l lowers it by 1 − lt/2 of its slope's
// prediction; Armijo's condition with the usual constant (Nocedal and Wright 2006, section 3.1) requires 1e-4 of it.
TEST(LineSearch, TakesTheLongestMoveThatLowersGByATenThousandthOfItsSlope) {
  Cloth cloth;
  cloth.positions = random_vertices(5, 1);
  cloth.velocities = Vertices::Zero(5, 3);
  cloth.masses = Eigen::VectorXd::LinSpaced(5, 0.5, 2);
  const System system(cloth, 0.1);
  StepObjective objective(system, system.step);
  objective.begin(cloth.positions, cloth.velocities, Vertices::Zero(5, 3), system.step);
  Told minimiser(system, objective);
  struct Move {
    double t, length;
  };
  for (const Move& move : {Move{0.1, 1}, Move{1, 1}, Move{1.5, 1}, Move{1.999, 1}, Move{1.9999, 0.5}, Move{2.5, 0.5},
                           Move{3.999, 0.5}, Move{3.9999, 0.25}}) {
    Iterate point{.x = objective.y() + random_vertices(5, 2), .gradient = Vertices::Zero(5, 3)};
    point.value = objective.evaluate(point.x, point.gradient);
    const Vertices away = point.x - objective.y();
    const Vertices direction = move.t * away;
    EXPECT_EQ(minimiser.descend(point, direction, dot(point.gradient, direction)), move.length) << move.t;
    EXPECT_LT((point.x - objective.y() - (1 - move.length * move.t) * away).norm(), 1e-14 * away.norm()) << move.t;
  }
}

/// Returns g by its formula, in extended precision, from the objective's numbers.
long double exact_value(const StepObjective& objective, const Cloth& cloth, const Vertices& x) {
  using Row = Eigen::Matrix<long double, 1, 3>;
  long double sum = 0;
  for (int i = 0; i < cloth.vertex_count(); ++i) {
    const Row way = x.row(i).cast<long double>() - objective.y().row(i).cast<long double>();
    sum += objective.inertia()[i] * way.squaredNorm() / 2;
  }
  for (const Spring& s : cloth.springs) {
    const long double length = Row(x.row(s.i).cast<long double>() - x.row(s.j).cast<long double>()).norm();
    sum += s.stiffness * (length - s.rest_length) * (length - s.rest_length) / 2;
  }
  return sum;
}

// Rounding allowance of a line search that must not go uphill: sufficient, and not much larger.
TEST(ObjectiveRounding, IsAsLargeAsItHasToBe) {
  double largest = 0;
  for (const double stiffness : {1.0, 180.0, 1e6}) {
    for (const Cloth& original : {grid_cloth(2, stiffness), grid_cloth(12, stiffness), irregular_cloth(stiffness)}) {
      const Cloth cloth = disturbed(original);
      const System system(cloth, 0.02);
      StepObjective objective(system, system.step);
      objective.begin(cloth.positions, cloth.velocities, Vertices::Zero(cloth.vertex_count(), 3), system.step);
      for (int seed = 1; seed <= 10; ++seed) {
        const double size = std::pow(10.0, -seed);
        const Vertices x = objective.y() + size * random_vertices(cloth.vertex_count(), seed);
        Vertices gradient = Vertices::Zero(cloth.vertex_count(), 3);
        const double value = objective.evaluate(x, gradient);
        const auto error = static_cast<double>(std::abs(value - exact_value(objective, cloth, x)));
        const double allowed = objective.rounding(value);
        EXPECT_LE(error, allowed) << size << " m at " << stiffness << " N/m";
        largest = std::max(largest, error / allowed);
      }
    }
  }
  EXPECT_GT(largest, 1e-3);
}

// The bending energy of a flat cloth may come out slightly negative.
TEST(ObjectiveRounding, KnowsNoSign) {
  const Cloth cloth = grid_cloth(2, 180);
  const System system(cloth, 0.02);
  StepObjective objective(system, system.step);
  objective.begin(cloth.positions, cloth.velocities, Vertices::Zero(cloth.vertex_count(), 3), system.step);
  EXPECT_GT(objective.rounding(-1e-17), 0);
  EXPECT_EQ(objective.rounding(-1e-17), objective.rounding(1e-17));
}

/// Returns the springs' energy at x.
double elastic(const StepObjective& objective, const Vertices& x) {
  Vertices gradient = Vertices::Zero(x.rows(), 3);
  return objective.evaluate(x, gradient) - objective.inertial_value(x);
}

TEST(LeastElastic, IsBelowWhatTheSpringsHaveAnywhereNear) {
  for (const Cloth& original : {grid_cloth(12), irregular_cloth()}) {
    const Cloth cloth = disturbed(original);
    const System system(cloth, 0.02);
    StepObjective objective(system, system.step);
    const Vertices& x = cloth.positions;
    objective.begin(x, cloth.velocities, Vertices::Zero(x.rows(), 3), system.step);
    const double energy = elastic(objective, x);
    for (int seed = 1; seed <= 10; ++seed) {
      const double distance = std::pow(10.0, -seed);
      const Vertices moved = x + distance * random_vertices(x.rows(), seed).rowwise().normalized();
      EXPECT_LE(objective.least_elastic(energy, distance), elastic(objective, moved)) << distance << " m";
    }
    EXPECT_GE(objective.least_elastic(energy, 1e-14), (1 - 1e-9) * energy);
    EXPECT_EQ(objective.least_elastic(energy, 100), 0);
  }
}

TEST(LeastElastic, IsReachedByASpringWhoseEndsMoveTowardsEachOther) {
  constexpr double stiffness = 180, rest_length = 0.5, stretch = 0.1, distance = 0.02;
  Cloth cloth;
  cloth.positions = Vertices::Zero(2, 3);
  cloth.positions(1, 0) = rest_length + stretch;
  cloth.velocities = Vertices::Zero(2, 3);
  cloth.masses = Eigen::VectorXd::Ones(2);
  cloth.springs = {{.i = 0, .j = 1, .rest_length = rest_length, .stiffness = stiffness}};
  const System system(cloth, 0.02);
  const StepObjective objective(system, system.step);
  const double energy = stiffness / 2 * stretch * stretch, left = stretch - 2 * distance;
  EXPECT_NEAR(objective.least_elastic(energy, distance), stiffness / 2 * left * left, 1e-12);
}

/// A change of the unknowns and the corresponding change of the gradient.
struct CurvaturePair {
  Eigen::VectorXd step, change;
};

/// Returns BFGS's inverse Hessian from γA⁻¹ and these pairs, the oldest first, by its formula; γ fits it to the newest
/// pair in the norm of A⁻¹ (Nocedal and Wright 2006, eqs. 6.17 and 7.20, the latter preconditioned).
Eigen::MatrixXd dense_bfgs(const Eigen::MatrixXd& inverse, const std::vector<CurvaturePair>& pairs) {
  Eigen::MatrixXd h = inverse;
  if (pairs.empty()) return h;
  const CurvaturePair& newest = pairs.back();
  h *= newest.step.dot(newest.change) / newest.change.dot(inverse * newest.change);
  for (const CurvaturePair& pair : pairs) {
    const double rho = 1 / pair.step.dot(pair.change);
    const Eigen::MatrixXd project =
        Eigen::MatrixXd::Identity(h.rows(), h.rows()) - rho * pair.step * pair.change.transpose();
    h = project * h * project.transpose() + rho * pair.step * pair.step.transpose();
  }
  return h;
}

TEST(LbfgsHistory, GivesTheDirectionsOfTheDenseFormula) {
  constexpr int vertices = 5, unknowns = 3 * vertices, iterations = 12;
  // A convex function, ½xᵀQx + ¼Σx⁴, and a matrix A that is not its Hessian.
  const Eigen::MatrixXd random = random_vertices(unknowns * unknowns / 3, 1).reshaped(unknowns, unknowns);
  const Eigen::MatrixXd q = random * random.transpose() + Eigen::MatrixXd::Identity(unknowns, unknowns);
  const Eigen::MatrixXd other = random_vertices(unknowns * unknowns / 3, 2).reshaped(unknowns, unknowns);
  const Eigen::MatrixXd a = 0.3 * q + other * other.transpose() + Eigen::MatrixXd::Identity(unknowns, unknowns);
  const Eigen::MatrixXd inverse = a.inverse();
  const auto as_vertices = [](const Eigen::VectorXd& v) { return Vertices(v.reshaped(vertices, 3)); };

  LbfgsHistory history(vertices);
  std::vector<CurvaturePair> pairs;
  Eigen::VectorXd x = 2 * random_vertices(vertices, 3).reshaped(), last_gradient;
  for (int k = 0; k < iterations; ++k) {
    const Eigen::VectorXd gradient = q * x + x.array().cube().matrix();
    if (k > 0) pairs.back().change = gradient - last_gradient;
    const Vertices preconditioned = as_vertices(inverse * gradient);
    Vertices direction = Vertices::Zero(vertices, 3);
    history.observe(as_vertices(gradient), preconditioned);
    history.find_direction(preconditioned, direction);
    const Eigen::VectorXd expected = dense_bfgs(inverse, pairs) * gradient;
    EXPECT_LT((direction.reshaped() - expected).norm(), 1e-9 * expected.norm()) << "iteration " << k;

    const double length = k % 3 == 0 ? 0.5 : 1;
    history.moved(direction, length, gradient.dot(expected));
    pairs.push_back({.step = -length * expected, .change = {}});
    if (pairs.size() > LbfgsHistory::capacity) pairs.erase(pairs.begin());
    x -= length * expected;
    last_gradient = gradient;
  }
}

}  // namespace
}  // namespace drape::test
