// A cloth never passes through itself: every step is checked by testing all pairs.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "drape/sim/effects/ground.hpp"
#include "drape/sim/effects/self_collision.hpp"
#include "drape/sim/simulation.hpp"
#include "sim/collision/distance.hpp"
#include "tests/support/intersections.hpp"
#include "tests/support/meshes.hpp"
#include "tests/support/setups.hpp"

namespace drape::test {
namespace {

class SelfCollision : public testing::TestWithParam<NamedMethod> {
 protected:
  static double step() { return GetParam().is_explicit() ? 0.001 : 0.01; }
};
INSTANTIATE_TEST_SUITE_P(With, SelfCollision, testing::ValuesIn(all_methods), method_name);

/// Runs a scene and expects that no vertex or edge passes through a triangle in any step.
void expect_no_crossings(const SimulationSettings& settings, double seconds) {
  Simulation simulation(settings);
  const auto& triangles = settings.cloth.triangles;
  ASSERT_EQ(self_intersections(triangles, simulation.state().x), 0);
  while (simulation.time() < seconds) {
    const Vertices before = simulation.state().x;
    simulation.step();
    const Vertices& x = simulation.state().x;
    ASSERT_EQ(self_crossings(triangles, before, x), 0) << "at step " << simulation.state().step;
    ASSERT_EQ(self_intersections(triangles, x), 0) << "at step " << simulation.state().step;
  }
}

/// Returns true if a scene without self-collision passes through itself, so that there is something to prevent.
bool ever_intersects(SimulationSettings settings, double seconds) {
  drape::Effects others;
  for (const Effect& effect : settings.effects) {
    if (effect.as<drape::SelfCollision>() == nullptr) others.add(effect);
  }
  settings.effects = others;
  Simulation simulation(settings);
  while (simulation.time() < seconds) {
    simulation.step();
    if (self_intersections(settings.cloth.triangles, simulation.state().x) > 0) return true;
  }
  return false;
}

/// Makes a cloth that falls beside the middle of a small sphere, slides off, and lies on the floor in folds.
SimulationSettings fold_scene(Solver solver, double step, int cells) {
  SimulationSettings settings = setup(cloth_of(make_grid(cells, cells), 0.5, 100, {}), solver, step);
  settings.effects = {Gravity{}, Sphere{.center = Eigen::Vector3d(0.13, -0.07, -0.5), .radius = 0.3, .scale = 1.2},
                      Ground{.height = -1}, drape::SelfCollision{.thickness = 0.02}};
  return settings;
}

TEST_P(SelfCollision, KeepsAClothThatFoldsOnTheFloorFromGoingThroughItself) {
  const SimulationSettings settings = fold_scene(GetParam(), step(), 14);
  EXPECT_TRUE(ever_intersects(settings, 2)) << "nothing to prevent";
  expect_no_crossings(settings, 2);
}

// A released curtain falls along itself, fold on fold: the hardest case.
TEST_P(SelfCollision, KeepsAFallingCurtainFromGoingThroughItself) {
  Mesh mesh = make_grid(5, 12);
  mesh.positions.col(0) *= 0.5;
  mesh.positions.col(2) = mesh.positions.col(1);
  for (Eigen::Index i = 0; i < mesh.positions.rows(); ++i) {
    mesh.positions(i, 1) = 0.03 * std::sin(5 * mesh.positions(i, 2) + mesh.positions(i, 0));
  }
  SimulationSettings settings = setup(cloth_of(mesh, 0.3, 60, {}), GetParam(), step());
  settings.effects = {Gravity{}, Ground{.height = -1.06, .friction = 1}, drape::SelfCollision{.thickness = 0.015}};
  EXPECT_TRUE(ever_intersects(settings, 3)) << "nothing to prevent";
  expect_no_crossings(settings, 0.8);
}

/// Makes two sheets of one cloth, one above the other, without a common vertex.
Cloth two_sheets(double mass) {
  const Mesh lower = make_grid(6, 6);
  Mesh mesh = lower;
  const auto count = static_cast<int>(lower.positions.rows());
  mesh.positions.resize(2 * lower.positions.rows(), 3);
  mesh.positions.topRows(count) = lower.positions;
  mesh.positions.bottomRows(count) = (0.7 * lower.positions).rowwise() + Eigen::RowVector3d(0.03, 0.02, 0.3);
  for (const Triangle& t : lower.triangles) mesh.triangles.push_back({t[0] + count, t[1] + count, t[2] + count});
  mesh.uvs.clear();
  return cloth_of(mesh, mass, 100, {});
}

// They meet at 40 m/s: in one step of 0.01 s they would pass each other.
TEST_P(SelfCollision, KeepsTheMomentumOfTwoSheetsThatCollide) {
  Cloth cloth = two_sheets(1);
  for (int i = 0; i < cloth.vertex_count(); ++i) {
    cloth.masses[i] *= 1 + 0.5 * std::sin(i);
    const double side = i < cloth.vertex_count() / 2 ? 1 : -1;
    cloth.velocities.row(i) << 3, -2 * side, 20 * side;
  }
  SimulationSettings settings = setup(cloth, Method::semi_implicit, 0.001);
  if (!GetParam().is_explicit()) settings = setup(cloth, GetParam(), 0.01);
  settings.integrator.stop = StoppingRule::gradient;
  settings.integrator.tolerance = 1e-9;
  settings.integrator.max_iterations = 3000;
  settings.effects = {drape::SelfCollision{.thickness = 0.01}};
  Simulation simulation(settings);
  const Eigen::RowVector3d before = cloth.masses.transpose() * simulation.state().v;
  bool met = false;
  for (int i = 0; i < 60; ++i) {
    simulation.step();
    const Vertices& x = simulation.state().x;
    ASSERT_EQ(self_intersections(cloth.triangles, x), 0) << "at step " << i;
    const auto half = cloth.vertex_count() / 2;
    met |= simulation.state().v.topRows(half).col(2).mean() < 15;
  }
  EXPECT_TRUE(met) << "the sheets never met";
  const Eigen::RowVector3d after = cloth.masses.transpose() * simulation.state().v;
  EXPECT_LT((after - before).norm(), 1e-9 * cloth.masses.sum() * 20);
}

// Layers that rest on each other end at the distance of the thickness, and stay.
TEST_P(SelfCollision, LaysLayersTheThicknessApart) {
  constexpr double thickness = 0.04;
  SimulationSettings settings = setup(two_sheets(0.5), GetParam(), step());
  settings.cloth.positions.bottomRows(49).col(2).array() -= 0.25;
  settings.effects = {Gravity{}, Ground{.height = -0.01}, drape::SelfCollision{.thickness = thickness},
                      Damping{.factor = 0.1}};
  Simulation simulation(settings);
  while (simulation.time() < 1.5) simulation.step();
  const Vertices& x = simulation.state().x;
  for (int v = 49; v < 98; ++v) {
    double gap = 1;
    for (const Triangle& t : settings.cloth.triangles) {
      if (t[0] >= 49) continue;
      const FourPoints p{x.row(v).transpose(), x.row(t[0]).transpose(), x.row(t[1]).transpose(),
                         x.row(t[2]).transpose()};
      gap = std::min(gap, std::sqrt(nearest(Feature::vertex_triangle, p).squared));
    }
    EXPECT_GT(gap, 0.9 * thickness) << "vertex " << v;
    EXPECT_LT(gap, 1.3 * thickness) << "vertex " << v;
  }
}

// The same start gives the same bits, also after other motions have used the same memory.
TEST(SelfCollisionAlone, DependsOnTheStateOnly) {
  const SimulationSettings settings = fold_scene(Method::liu13, 0.01, 12);
  Simulation first(settings), second(settings);
  for (int i = 0; i < 100; ++i) first.step();
  const State middle = first.state();
  for (int i = 0; i < 20; ++i) first.step();
  second.restore(middle);
  for (int i = 0; i < 20; ++i) second.step();
  EXPECT_TRUE(same_bits(first.state().x, second.state().x));
  EXPECT_TRUE(same_bits(first.state().v, second.state().v));
}

// A mesh finer than the thickness is not pushed apart at rest.
TEST(SelfCollisionAlone, LeavesAFlatClothAlone) {
  SimulationSettings settings = setup(cloth_of(make_grid(30, 30), 1, 100, {}), Method::liu13, 0.01);
  settings.effects = {drape::SelfCollision{.thickness = 0.2}};
  Simulation simulation(settings);
  for (int i = 0; i < 5; ++i) simulation.step();
  EXPECT_LT((simulation.state().x - settings.cloth.positions).cwiseAbs().maxCoeff(), 1e-9);
}

}  // namespace
}  // namespace drape::test
