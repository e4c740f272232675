// Cloth that is fast, or pressed upon something sharp, or wound up by its pins: nothing passes at any step.

#include <gtest/gtest.h>

#include "drape/sim/effects/moving_pins.hpp"
#include "tests/contact/contact_setup.hpp"
#include "tests/support/audited_run.hpp"

namespace drape::test {
namespace {

using Eigen::Vector3d;

class Thrown : public Solved {};
INSTANTIATE_TEST_SUITE_P(With, Thrown, testing::ValuesIn(contact_methods), method_name);

void expect_nothing_to_pass(const SimulationSettings& settings, double seconds) {
  const SimulationSettings s = in_substeps(settings);
  const AuditedRun audited = audit_run(s, std::lround(seconds / s.step));
  EXPECT_EQ(audited.with_passages, 0) << lines(audited.first);
  EXPECT_EQ(audited.with_crossings, 0) << lines(audited.first);
  EXPECT_EQ(audited.deepest, 0);
}

/// A sheet that is thrown down and, with its whole edge ahead, across the thing that it meets.
SimulationSettings thrown(SimulationSettings s, double speed) {
  s.cloth.velocities = (speed * Eigen::RowVector3d(0.1, 0, -1)).replicate(s.cloth.vertex_count(), 1);
  s.effects.add(solved_self());
  return s;
}

TEST_P(Thrown, AtARodOf2MillimetresStaysOnItsSide) {
  SimulationSettings s = settings(plain_sheet(level_square(0.5, 8, 0.05)), 0.005);
  s.effects.add(Body{.box = Vector3d(0.002, 2, 0.002), .center = Vector3d(0.03, 0, 0), .thickness = 0.005});
  expect_nothing_to_pass(thrown(s, 20), 0.05);
}

TEST_P(Thrown, AtASpikeStaysAroundIt) {
  SimulationSettings s = settings(plain_sheet(level_square(0.5, 6, 0.03)), 0.005);
  const BodyShape spike{.kind = BodyShape::Kind::cone, .radius = 0.02, .height = 0.4, .segments = 12};
  s.effects.add(Body{.center = Vector3d(0.03, 0.02, -0.2), .thickness = 0.005, .shape = spike});
  expect_nothing_to_pass(thrown(s, 20), 0.05);
}

TEST_P(Thrown, ALooselySolvedSheetGetsItsMomentumOutsideOfWhatItMeets) {
  for (int pose = 0; pose < 8; ++pose) {
    Mesh rest = level_square(0.5, 8, 0), start = rest;
    start.positions *= 1 + 0.05 * pose;
    start.positions.col(2).array() += 0.02 * (1 + rest.positions.col(0).array() * (pose - 3));
    Cloth cloth = make_cloth(start, rest, 0.05, 1800, {});
    SimulationSettings s = settings(cloth, 0.01);
    s.integrator.max_iterations = 3;
    s.integrator.tolerance = 1;
    s.effects.add(
        Body{.box = Vector3d(0.02, 2, 0.02), .center = Vector3d(0.013 * pose - 0.05, 0, -0.01), .thickness = 0.005});
    expect_nothing_to_pass(thrown(s, 3), 0.03);
  }
}

TEST_P(Thrown, AStripThatItsPinsWindUpDoesNotPassThroughItself) {
  constexpr int along = 16;
  Mesh mesh = make_grid(along, 2);
  mesh.positions.col(0) *= 0.4;
  mesh.positions.col(1) *= 0.05;
  Cloth strip = make_cloth(mesh, mesh, 0.02, 180, {0, along, along + 1, 2 * along + 1, 2 * along + 2, 3 * along + 2});
  SimulationSettings s = settings(strip, 0.01);
  s.effects.add(MovingPins{.pins = {along, 2 * along + 1, 3 * along + 2},
                           .keyframes = {{.time = 1, .value = {-0.1, 0, 0}}},
                           .turns = {{.time = 1, .value = {2700, 0, 0}}}});
  s.effects.add(SelfCollision{.thickness = 0.005});
  expect_nothing_to_pass(s, 0.6);
}

}  // namespace
}  // namespace drape::test
