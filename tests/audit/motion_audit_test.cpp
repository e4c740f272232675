// Whole motions under the exact checks: defects inserted by hand are found, and nothing else.

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "audit/motion_audit.hpp"
#include "drape/sim/mesh.hpp"

namespace drape::audit {
namespace {

const std::vector<Collider> no_colliders;

AuditedCloth sheet(const Mesh& grid, const Held& held = {.known = true, .vertices = {}}) {
  return {.rest = grid.positions, .triangles = grid.triangles, .held = held};
}

/// Returns a grid after a free fall of some steps of 20 ms.
Vertices fallen(const Mesh& grid, int step) {
  Vertices x = grid.positions;
  x.col(2).array() -= 0.5 * 9.81 * std::pow(0.02 * step, 2);
  return x;
}

class FallingSheet : public testing::Test {
 protected:
  const Mesh grid = make_grid(8, 8);
  MotionAudit audit{sheet(grid), {.stretch = 1.1}};

  void add(int step, const Vertices& x, const std::vector<Collider>& colliders = no_colliders) {
    audit.add({step, 0.02 * step, x, colliders});
  }
};

TEST_F(FallingSheet, WithoutAFaultIsClean) {
  for (int step = 0; step < 20; ++step) add(step, fallen(grid, step));
  EXPECT_TRUE(audit.clean());
  EXPECT_EQ(audit.states(), 20);
  EXPECT_NEAR(audit.findings(Check::stretch).largest, 1, 1e-12);
}

TEST_F(FallingSheet, IsFoundToCrossWhereOneVertexGoesThroughATriangleForOneFrame) {
  for (int step = 0; step < 6; ++step) {
    Vertices x = fallen(grid, step);
    if (step == 3) {  // folds the corner through the sheet's middle
      x.row(0) = x.row(40) + Eigen::RowVector3d(0.06, 0.02, -0.1);
      x.row(1) = x.row(40) + Eigen::RowVector3d(0.05, 0.01, 0.1);
    }
    add(step, x);
  }
  const CheckFindings& crossings = audit.findings(Check::crossings);
  EXPECT_EQ(crossings.states, 1);
  EXPECT_EQ(crossings.first, 3);
  EXPECT_EQ(crossings.worst.step, 3);
  EXPECT_GE(crossings.worst.count, 1U);
  EXPECT_NE(crossings.worst.text.find("cloth edge 0 1 goes through cloth triangle"), std::string::npos)
      << crossings.worst.text;
  EXPECT_EQ(audit.findings(Check::ways).states, 2);  // into the defect and back
  EXPECT_FALSE(audit.clean());
}

TEST_F(FallingSheet, IsFoundWhereAnEdgeIsLongerThanTheLimit) {
  for (int step = 0; step < 4; ++step) {
    Vertices x = fallen(grid, step);
    if (step == 2) x(0, 0) -= 0.2 * 0.25;  // a corner's side grows from 0.25 to 0.3
    add(step, x);
  }
  const CheckFindings& stretch = audit.findings(Check::stretch);
  EXPECT_EQ(stretch.states, 1);
  EXPECT_EQ(stretch.first, 2);
  EXPECT_NEAR(stretch.worst.value, 1.2, 1e-12);
  EXPECT_EQ(stretch.worst.text, "cloth edge 0 1 is stretched to 1.2");
  EXPECT_EQ(audit.findings(Check::crossings).states, 0);
}

TEST_F(FallingSheet, IsFoundWhereItPassesThroughABodyBetweenTwoStates) {
  const Mesh plate = make_grid(1, 1);
  MeshShape body{.triangles = std::make_shared<const std::vector<Triangle>>(plate.triangles),
                 .positions = 0.9 * plate.positions};
  body.positions.col(2).array() -= 0.05;
  for (int step = 0; step < 12; ++step) add(step, fallen(grid, step), {body});
  EXPECT_EQ(audit.findings(Check::crossings).states, 0);
  EXPECT_EQ(audit.findings(Check::ways).states, 1);
  EXPECT_NE(audit.findings(Check::ways).worst.text.find("body triangle"), std::string::npos);
}

TEST_F(FallingSheet, IsFoundUnderAGroundByItsDepth) {
  const GroundShape ground{.normal = Eigen::Vector3d::UnitZ(), .height = -0.1};
  for (int step = 0; step < 8; ++step) add(step, fallen(grid, step), {ground});
  const CheckFindings& inside = audit.findings(Check::inside);
  EXPECT_EQ(inside.states, 0);  // ½·9.81·0.14² = 0.0961 m
  add(8, fallen(grid, 8), {ground});
  EXPECT_EQ(inside.states, 1);
  EXPECT_NEAR(inside.worst.value, 0.5 * 9.81 * 0.16 * 0.16 - 0.1, 1e-12);
  EXPECT_EQ(inside.worst.count, 81U);
}

/// Returns a falling sheet with one vertex that stays in place from a step on, like a held one.
Vertices fallen_but(const Mesh& grid, int step, int vertex, int from) {
  Vertices x = fallen(grid, step);
  if (step > from) x.row(vertex) = fallen(grid, from).row(vertex);
  return x;
}

TEST_F(FallingSheet, IsFoundWhereAVertexStopsInMidAir) {
  for (int step = 0; step < 16; ++step) add(step, fallen_but(grid, step, 40, 5));
  const CheckFindings& stuck = audit.findings(Check::stuck);
  EXPECT_GT(stuck.states, 0);
  EXPECT_EQ(stuck.worst.vertices, std::vector<int>{40});
}

TEST_F(FallingSheet, MayHaveAVertexThatAGroundSupports) {
  const GroundShape ground{.normal = Eigen::Vector3d::UnitZ(), .height = fallen(grid, 5)(40, 2)};
  for (int step = 0; step < 16; ++step) add(step, fallen_but(grid, step, 40, 5), {ground});
  EXPECT_EQ(audit.findings(Check::stuck).states, 0);
}

TEST(HeldVertices, MayStandStill) {
  const Mesh grid = make_grid(8, 8);
  MotionAudit pinned(sheet(grid, {.known = true, .vertices = {40}}), {}), unknown(sheet(grid, {}), {}),
      loose(sheet(grid), {});
  for (int step = 0; step < 16; ++step) {
    const Vertices x = fallen_but(grid, step, 40, 0);
    for (MotionAudit* audit : {&pinned, &unknown, &loose}) audit->add({step, 0.02 * step, x, no_colliders});
  }
  EXPECT_EQ(pinned.findings(Check::stuck).states, 0);
  EXPECT_EQ(unknown.findings(Check::stuck).states, 0);
  EXPECT_GT(loose.findings(Check::stuck).states, 0);
}

TEST(MotionAudit, RefusesStatesThatCannotBeJudged) {
  const Mesh grid = make_grid(2, 2);
  MotionAudit audit(sheet(grid), {});
  Vertices x = grid.positions;
  EXPECT_THROW(audit.add({0, 0, x.topRows(4), no_colliders}), std::invalid_argument);
  x(3, 1) = NAN;
  EXPECT_THROW(audit.add({0, 0, x, no_colliders}), std::invalid_argument);
  EXPECT_THROW(MotionAudit({.rest = grid.positions, .triangles = {{0, 1, 99}}, .held = {}}, {}), std::invalid_argument);
}

}  // namespace
}  // namespace drape::audit
