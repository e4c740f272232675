#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <vector>

#include "sim/linear/newton_cholesky.hpp"
#include "tests/support/matrices.hpp"
#include "tests/support/meshes.hpp"
#include "tests/support/plain_springs.hpp"
#include "tests/support/random.hpp"
#include "tests/support/setups.hpp"

namespace drape::test {
namespace {

/// Flattens to x, y, z of vertex 0 first.
Eigen::VectorXd by_vertex(const Vertices& v) {
  const Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor> rows = v;
  return Eigen::Map<const Eigen::VectorXd>(rows.data(), rows.size());
}

struct Case {
  const char* name;
  std::unique_ptr<NewtonSolver> (*make)(const System& system, const StepObjective& objective);
  double tolerance;  // of ‖H p − b‖/‖b‖
};

template <class Solver>
std::unique_ptr<NewtonSolver> make(const System& system, const StepObjective& objective) {
  return std::make_unique<Solver>(system, objective);
}

class NewtonEquations : public testing::TestWithParam<Case> {
 protected:
  /// Returns p of a cloth's equations H(x) p = b with steps of h.
  Vertices solve(const Cloth& cloth, double h, const Vertices& x, const Vertices& b) const {
    const System system(cloth, h);
    const StepObjective objective(system, system.step);
    const auto solver = GetParam().make(system, objective);
    Vertices direction = Vertices::Constant(cloth.vertex_count(), 3, 99);
    solver->solve(cloth.positions, b, 0, direction);  // the same object solves for other x
    solver->solve(x, b, 0, direction);
    for (const int pin : cloth.pins) EXPECT_EQ(direction.row(pin).norm(), 0);
    return direction;
  }
};
// Conjugate gradients stop at a hundredth: Newton's next iteration compensates for it.
INSTANTIATE_TEST_SUITE_P(By, NewtonEquations,
                         testing::Values(Case{"Cholesky", make<NewtonCholesky>, 1e-11},
                                         Case{"ConjugateGradients", make<ConjugateGradients>, 1.01e-2},
                                         Case{"TheCheaper", make<CheaperNewton>, 1.01e-2}),
                         [](const auto& tested) { return tested.param.name; });

/// Returns random forces on the free vertices.
Vertices forces(const Cloth& cloth, int seed) {
  Vertices b = random_vertices(cloth.vertex_count(), seed);
  for (const int pin : cloth.pins) b.row(pin).setZero();
  return b;
}

double residual(const Cloth& cloth, double h, const Vertices& x, const Vertices& direction, const Vertices& b) {
  const System system(cloth, h);
  return (newton_matrix(system, x) * by_vertex(direction) - by_vertex(b)).norm() / b.norm();
}

TEST_P(NewtonEquations, AreSolvedWithStretchedAndCompressedSprings) {
  for (const Mesh& mesh : {make_grid(15, 15), irregular_mesh(12), three_sheets(7)}) {
    const Cloth cloth = cloth_of(mesh, 1, 180, {0, 7});
    for (const int seed : {1, 2}) {
      const Vertices x = cloth.positions + 0.1 * random_vertices(cloth.vertex_count(), seed);
      const Vertices b = forces(cloth, 9);
      EXPECT_LT(residual(cloth, 0.02, x, solve(cloth, 0.02, x, b), b), GetParam().tolerance);
    }
  }
}

TEST_P(NewtonEquations, AreSolvedForALargeCloth) {
  const Cloth cloth = cloth_of(make_grid(47, 45), 1, 180, {0, 47});
  const Vertices x = cloth.positions + 0.02 * random_vertices(cloth.vertex_count(), 1);
  const Vertices b = forces(cloth, 2);
  EXPECT_LT(residual(cloth, 0.02, x, solve(cloth, 0.02, x, b), b), GetParam().tolerance);
}

// If every spring is stretched, H is the derivative of the gradient. Central differences have an error of ε² times the
// gradient's third derivatives, and its rounding over ε.
TEST_P(NewtonEquations, HoldTheDerivativeOfTheGradientWhereAllSpringsAreStretched) {
  const Cloth cloth = cloth_of(irregular_mesh(6), 1, 180, {0, 3});
  const Vertices x = 1.5 * cloth.positions;
  const Vertices b = forces(cloth, 4);
  const Vertices direction = solve(cloth, 0.02, x, b);

  constexpr double epsilon = 1e-4;
  Vertices product = (cloth.masses / (0.02 * 0.02)).asDiagonal() * direction;
  product += (plain_gradient(cloth.springs, x + epsilon * direction) -
              plain_gradient(cloth.springs, x - epsilon * direction)) /
             (2 * epsilon);
  for (const int pin : cloth.pins) product.row(pin).setZero();
  EXPECT_LT((product - b).norm(), (GetParam().tolerance + 1e-7) * b.norm());
}

TEST_P(NewtonEquations, PointDownhillHoweverCompressedTheClothIs) {
  const Cloth cloth = cloth_of(make_grid(10, 10), 1, 1e6, {0});
  const Vertices b = forces(cloth, 4);
  for (const double scale : {0.5, 1e-3, 0.0}) {  // finally all vertices coincide
    const Vertices direction = solve(cloth, 0.1, scale * cloth.positions, b);
    EXPECT_TRUE(direction.allFinite());
    EXPECT_GT(b.cwiseProduct(direction).sum(), 0);
  }
}

TEST_P(NewtonEquations, OfAClothThatIsAllPinsGiveZero) {
  const Cloth cloth = cloth_of(make_grid(3, 3), 1, 180, every(16));
  EXPECT_EQ(solve(cloth, 0.02, cloth.positions, Vertices::Zero(16, 3)).norm(), 0);
}

/// Contacts between vertices of a cloth that its springs do not couple, some of them pins.
class ContactsOfNewtonsEquations : public testing::Test {
 protected:
  Cloth cloth_ = cloth_of(make_grid(12, 12), 1, 180, {0, 12});
  System system_{cloth_, 0.02};
  StepObjective objective_{system_, system_.step};
  Vertices x_ = cloth_.positions + 0.02 * random_vertices(cloth_.vertex_count(), 1);
  Vertices b_ = forces(cloth_, 2);

  static ContactBlock contact(std::array<int, 4> vertices) {
    const Eigen::Vector3d normal = Eigen::Vector3d(1, 2, 3).normalized();
    return {4, vertices, {1, -0.5, -0.3, -0.2}, 5000 * normal * normal.transpose()};
  }

  Vertices solve(NewtonCholesky& solver, const std::vector<ContactBlock>& contacts) const {
    EXPECT_TRUE(solver.set_contacts(contacts));
    Vertices direction(cloth_.vertex_count(), 3);
    solver.solve(x_, b_, 0, direction);
    return direction;
  }

  /// Returns ‖(H + contacts) direction − b‖/‖b‖.
  [[nodiscard]] double residual_of(const Vertices& direction, const std::vector<ContactBlock>& contacts) const {
    Vertices product = Vertices::Zero(cloth_.vertex_count(), 3);
    for (const ContactBlock& c : contacts) {
      Eigen::Vector3d way = Eigen::Vector3d::Zero();
      for (std::size_t i = 0; i < 4; ++i) way += c.weights[i] * direction.row(c.vertices[i]).transpose();
      for (std::size_t i = 0; i < 4; ++i) product.row(c.vertices[i]) += c.weights[i] * (c.stiffness * way).transpose();
    }
    for (const int pin : cloth_.pins) product.row(pin).setZero();
    return residual(cloth_, 0.02, x_, direction, b_ - product) * (b_ - product).norm() / b_.norm();
  }
};

TEST_F(ContactsOfNewtonsEquations, CoupleAnyVertices) {
  NewtonCholesky solver(system_, objective_);
  const std::vector<ContactBlock> few{contact({100, 3, 4, 17})},
      more{contact({100, 3, 4, 17}), contact({0, 90, 91, 60})};
  for (const auto& contacts : {few, more, few}) {
    EXPECT_LT(residual_of(solve(solver, contacts), contacts), 1e-10);
  }
}

// Otherwise a motion that is resumed would differ in rounding.
TEST_F(ContactsOfNewtonsEquations, LeaveNoTraceOnceTheyAreForgotten) {
  const std::vector<ContactBlock> once{contact({150, 20, 21, 34})}, now{contact({100, 3, 4, 17})};
  for (const auto& contacts : {now, std::vector<ContactBlock>()}) {
    NewtonCholesky solver(system_, objective_), fresh(system_, objective_);
    (void)solve(solver, once);
    solver.forget_contacts();
    EXPECT_EQ(solve(solver, contacts), solve(fresh, contacts));
  }
}

// Contacts between vertices anywhere make a cloth's factor almost that of a full matrix. Then the cloth is solved
// without them, and so it stays until they are forgotten.
TEST(NewtonsFactor, LeavesOutContactsThatMakeItTooExpensive) {
  const Cloth cloth = cloth_of(make_grid(110, 110), 1, 180, {0});
  const System system{cloth, 0.02};
  const StepObjective objective{system, system.step};
  const Vertices b = forces(cloth, 2);
  const auto solve = [&](NewtonCholesky& solver) {
    Vertices direction(cloth.vertex_count(), 3);
    solver.solve(cloth.positions, b, 0, direction);
    return direction;
  };
  Random random(3);
  std::vector<ContactBlock> many(40000);
  for (ContactBlock& contact : many) {
    const int one = random.below(cloth.vertex_count()), other = random.below(cloth.vertex_count());
    contact = {2, {one, other}, {1, -1}, 5000 * Eigen::Matrix3d::Identity()};
  }
  NewtonCholesky solver(system, objective), fresh(system, objective);
  const Vertices without = solve(fresh);
  EXPECT_FALSE(solver.set_contacts(many));
  EXPECT_EQ(solve(solver), without);
  EXPECT_FALSE(solver.set_contacts({many.front()}));
  solver.forget_contacts();
  EXPECT_TRUE(solver.set_contacts({many.front()}));
  EXPECT_NE(solve(solver), without);
}

}  // namespace
}  // namespace drape::test
