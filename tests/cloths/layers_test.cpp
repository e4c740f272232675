// Many cloths fall on each other: they come to rest as a stack, and nothing passes through anything on the way.

#include <gtest/gtest.h>

#include <vector>

#include "drape/sim/effects/damping.hpp"
#include "drape/sim/effects/ground.hpp"
#include "drape/sim/effects/self_collision.hpp"
#include "tests/cloths/panels.hpp"
#include "tests/support/audited_run.hpp"

namespace drape::test {
namespace {

constexpr double thickness = 0.01;  // [m]

/// Drops sheets of 5×5 cells on the ground, each a little beside the one below it, at gaps of 3 mm.
SimulationSettings dropped(int layers) {
  std::vector<Cloth> sheets;
  for (int k = 0; k < layers; ++k) {
    sheets.push_back(panel(5, 5, {0.3, 0.3}, {0.004 * (k % 3), 0.003 * (k % 2), (1.2 + 1.3 * k) * thickness}));
  }
  return exactly(
      joined(sheets), NamedMethod{Method::verlet, "Verlet"}, 0.01,
      {Gravity{}, Ground{.thickness = thickness}, SelfCollision{.thickness = thickness}, Damping{.factor = 0.3}});
}

TEST(Layers, TwentyRestOnEachOtherWithoutCrossing) {
  constexpr int layers = 20, steps = 100;
  const AuditedRun found = audit_run(dropped(layers), steps);
  EXPECT_EQ(found.with_passages, 0) << (found.first.empty() ? "" : found.first.front());
  EXPECT_EQ(found.with_crossings, 0);
  EXPECT_LT(found.deepest, 1e-6);
  const Eigen::Index sheet = found.last.x.rows() / layers;
  for (int k = 0; k < layers; ++k) {
    // Each lies at its place of the stack.
    EXPECT_NEAR(found.last.x.middleRows(k * sheet, sheet).col(2).mean(), (k + 1) * thickness, 0.3 * thickness) << k;
  }
  EXPECT_LT(found.last.v.rowwise().norm().mean(), 0.02);
}

}  // namespace
}  // namespace drape::test
