// The homework's table 2: the cloth of stiffness 180 N/m falls onto the sphere.

#include <gtest/gtest.h>

#include <algorithm>

#include "drape/sim/simulation.hpp"
#include "tests/support/setups.hpp"

namespace drape::test {
namespace {

constexpr double reach = 0.44;
constexpr double nearest_allowed = 0.37;  // the homework's own code reaches 0.377

double nearest(const Vertices& x) { return (x.rowwise() - homework_sphere_center).rowwise().norm().minCoeff(); }

/// Checks that the cloth lies on the sphere: its middle is above the sphere's centre, and vertices touch the sphere
/// near the top and on all four sides of it.
testing::AssertionResult lies_on_sphere(const Vertices& x) {
  constexpr int middle = 220;
  if (x(middle, 2) < homework_sphere_center[2]) return testing::AssertionFailure() << "its middle is below";
  bool top = false, left = false, right = false, front = false, back = false;
  for (Eigen::Index i = 0; i < x.rows(); ++i) {
    const Eigen::RowVector3d row = x.row(i) - homework_sphere_center;
    if (row.norm() > reach || row[2] < 0) continue;
    top |= row[2] > 0.95 * row.norm();
    left |= row[0] < -0.15;
    right |= row[0] > 0.15;
    front |= row[1] < -0.15;
    back |= row[1] > 0.15;
  }
  if (top && left && right && front && back) return testing::AssertionSuccess();
  return testing::AssertionFailure() << "touches at top " << top << ", left " << left << ", right " << right
                                     << ", front " << front << ", back " << back;
}

SimulationSettings table2(Method method, double step) {
  SimulationSettings settings = homework(method, step, 180);
  settings.effects.add(homework_sphere());
  return settings;
}

/// Runs to the end; after the fall, from 2 s on, the cloth must lie on the sphere.
void expect_covered_to_the_end(SimulationSettings settings, int steps) {
  Simulation simulation(std::move(settings));
  double least = reach;
  for (int step = 0; step < steps; ++step) {
    simulation.step();
    least = std::min(least, nearest(simulation.state().x));
    if (simulation.time() > 2) {
      ASSERT_TRUE(lies_on_sphere(simulation.state().x)) << "at " << simulation.time() << " s";
    }
  }
  EXPECT_GE(least, nearest_allowed);
  EXPECT_LT(least, reach) << "never touched";
}

TEST(Table2, SemiImplicitKeepsTheClothOnTheSphere) {
  SimulationSettings settings = table2(Method::semi_implicit, 0.001);
  settings.effects.add(homework_damping());
  expect_covered_to_the_end(settings, homework_small_steps);
}

TEST(Table2, Liu13KeepsTheClothOnTheSphere) { expect_covered_to_the_end(table2(Method::liu13, 0.02), homework_steps); }

// The implicit method eventually slides off, as in the homework, which shows its first 167 steps.
TEST(Table2, ImplicitNeverSinksIn) {
  Simulation simulation(table2(Method::implicit, 0.02));
  double least = reach;
  for (int step = 0; step < 167; ++step) {
    simulation.step();
    least = std::min(least, nearest(simulation.state().x));
  }
  EXPECT_GE(least, nearest_allowed);
  EXPECT_LT(least, reach) << "never touched";
}

}  // namespace
}  // namespace drape::test
