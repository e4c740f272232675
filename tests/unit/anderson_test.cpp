#include "sim/solvers/anderson.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

namespace drape::test {
namespace {

/// Affine map that turns the plane around a fixed point and shrinks distances from it by 1 %.
struct Spiral {
  Eigen::Vector2d center = {3, -2};
  Eigen::Matrix2d turn = 0.99 * Eigen::Rotation2Dd(2).toRotationMatrix();

  [[nodiscard]] Eigen::Vector2d operator()(const Eigen::Vector2d& u) const { return center + turn * (u - center); }
};

/// Returns the distance from the fixed point after so many iterations with a history of `depth`.
double distance_after(int iterations, std::size_t depth) {
  const Spiral map;
  AndersonAcceleration acceleration(depth);
  Eigen::Vector2d u = Eigen::Vector2d::Zero();
  for (int i = 0; i < iterations; ++i) u = acceleration.next(u, map(u), Eigen::Vector2d::Ones());
  return (u - map.center).norm();
}

// With as many differences as unknowns, the least-squares problem of an affine map has the solution zero.
TEST(AndersonAcceleration, SolvesAnAffineMapInOneIterationMoreThanItHasUnknowns) {
  EXPECT_LT(distance_after(3, 2), 1e-12);
  EXPECT_GT(distance_after(3, 1), 1e-3);
  const Spiral map;
  Eigen::Vector2d u = Eigen::Vector2d::Zero();
  for (int i = 0; i < 100; ++i) u = map(u);
  EXPECT_GT((u - map.center).norm(), 1);  // without it
}

Eigen::VectorXd three(double value) { return Eigen::VectorXd::Constant(3, value); }

TEST(AndersonAcceleration, TakesTheReachedValueAfterARestart) {
  AndersonAcceleration acceleration(3);
  acceleration.next(three(0), three(1), three(1));
  EXPECT_TRUE(acceleration.next(three(1), three(1.5), three(1)).isApprox(three(2)));
  acceleration.restart();
  EXPECT_EQ(acceleration.next(three(1), three(1.5), three(1)), three(1.5));
}

TEST(AndersonAcceleration, ForgetsAfterAChangeOfTheUnknownsAndAResidualThatGrows) {
  AndersonAcceleration acceleration(3);
  acceleration.next(three(0), three(1), three(1));
  const Eigen::VectorXd six = three(1).replicate(2, 1);
  EXPECT_EQ(acceleration.next(six, 1.5 * six, six), 1.5 * six);
  EXPECT_EQ(acceleration.next(six, 3 * six, six), 3 * six);
}

TEST(AndersonAcceleration, TakesTheReachedValueInsteadOfNoise) {
  AndersonAcceleration acceleration(3);
  acceleration.next(three(0), three(1), three(1));
  EXPECT_EQ(acceleration.next(three(1), three(1.99), three(1)), three(1.99));  // extrapolated to 100
  acceleration.restart();
  for (int i = 0; i < 6; ++i) EXPECT_EQ(acceleration.next(three(0), three(1), three(1)), three(1));  // no solution
}

}  // namespace
}  // namespace drape::test
