// A cloth does not go through itself: every step is looked at by trying all pairs.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/simulation.hpp"
#include "tests/support/intersections.hpp"
#include "tests/support/meshes.hpp"
#include "tests/support/setups.hpp"

namespace drape::test {
namespace {

class SelfCollision : public testing::TestWithParam<NamedMethod> {
 protected:
  static double step() { return GetParam().method == Method::semi_implicit ? 0.001 : 0.01; }
};
INSTANTIATE_TEST_SUITE_P(With, SelfCollision, testing::ValuesIn(all_methods), method_name);

/// A rough floor: what comes down to it stays where it is.
class Floor final : public Effect {
 public:
  explicit Floor(double height) : height_(height) {}
  void describe(Keys&) override {}
  void install(System& system) const override { system.filters.push_back(std::make_unique<Filter>(height_)); }

 private:
  struct Filter final : MotionFilter {
    double height;
    explicit Filter(double z) : height(z) {}
    void apply(const Vertices& x, double, double h, Vertices& v) override {
      for (Eigen::Index i = 0; i < x.rows(); ++i) {
        if (x(i, 2) + h * v(i, 2) < height) v.row(i) << 0, 0, std::max(0.0, height - x(i, 2)) * 10;
      }
    }
  };
  double height_;
};

ActiveEffect floor_at(double z) { return {"floor", std::make_shared<Floor>(z)}; }

KeyValues collision_keys(double thickness) { return {{"thickness", thickness}}; }

/// Runs a scene; no vertex and no edge may go through a triangle at any step.
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

/// Whether a scene without self-collision ever goes through itself: there must be something to prevent.
bool ever_intersects(SimulationSettings settings, double seconds) {
  std::erase_if(settings.effects, [](const ActiveEffect& e) { return e.name == "self_collision"; });
  Simulation simulation(settings);
  while (simulation.time() < seconds) {
    simulation.step();
    if (self_intersections(settings.cloth.triangles, simulation.state().x) > 0) return true;
  }
  return false;
}

/// A cloth that falls beside the middle of a small sphere, slides off, and comes to lie on the floor in folds.
SimulationSettings fold_scene(Solver solver, double step, int cells) {
  SimulationSettings settings = setup(cloth_of(make_grid(cells, cells), 0.5, 100, {}), solver, step);
  settings.effects = {
      effect("gravity"),
      effect("sphere",
             {{"center", Eigen::Vector3d(0.13, -0.07, -0.5)}, {"radius", 0.3}, {"scale", 1.2}, {"stiffness", 8000.0}}),
      floor_at(-1), effect("self_collision", collision_keys(0.02))};
  return settings;
}

TEST_P(SelfCollision, KeepsAClothThatFoldsOnTheFloorFromGoingThroughItself) {
  const SimulationSettings settings = fold_scene(GetParam(), step(), 14);
  EXPECT_TRUE(ever_intersects(settings, 2)) << "nothing to prevent";
  expect_no_crossings(settings, 2);
}

}  // namespace
}  // namespace drape::test
