// Fast bodies and cloths, and data remembered from one step to the next.

#include <gtest/gtest.h>

#include <memory>

#include "drape/sim/effects/body.hpp"
#include "drape/sim/simulation.hpp"
#include "tests/physics/contact_settings.hpp"

namespace drape::test {
namespace {

using Eigen::RowVector3d;
using Eigen::Vector3d;

/// Makes a square cloth around the z axis.
Cloth square_of(double side, int cells, double height) {
  Mesh mesh = make_grid(cells, cells);
  mesh.positions *= side / 2;
  mesh.positions.col(2).array() += height;
  return cloth_of(mesh, 0.2, 10, {});
}

class BodiesOnTheWay : public testing::TestWithParam<NamedMethod> {};
INSTANTIATE_TEST_SUITE_P(With, BodiesOnTheWay, testing::ValuesIn(all_methods), method_name);

TEST_P(BodiesOnTheWay, WhatComesFromTheSideDoesNotGoThrough) {
  // In one step from beside a sheet, above it, to below it: nothing is near at the start and the end of the step.
  SimulationSettings s = contact_settings(GetParam(), square_of(0.2, 2, 0), 0.01);
  s.effects = {};
  s.cloth.positions.rowwise() += RowVector3d(-1.2, 0.03, 0.1);
  s.cloth.velocities.rowwise() = RowVector3d(80, 0, -20);
  Body sheet{.thickness = 0.02};
  sheet.mesh = std::make_shared<MeshMotion>(MeshMotion{.mesh = make_grid(1, 1)});
  sheet.friction = 0;
  s.effects.add(sheet);
  Simulation simulation(s);
  for (int step = 0; step < 2; ++step) {
    simulation.step();
    ASSERT_GT(simulation.state().x.col(2).minCoeff(), 0) << "step " << step;
  }
}

TEST_P(BodiesOnTheWay, AStepDependsOnNothingButTheState) {
  SimulationSettings s = contact_settings(GetParam(), square_of(0.8, 8, 0.32), 0.01);
  s.integrator.tolerance = 1e-6;
  Body box{.thickness = 0.02};
  box.box = Vector3d(0.4, 0.4, 0.6);
  box.velocity = Vector3d(0.2, 0, 0);
  box.turns = {{1, {0, 0, 200}}};
  s.effects.add(box);
  Simulation first(s);
  for (int step = 0; step < 20; ++step) first.step();
  Simulation second(s);
  second.restore(first.state());
  for (int step = 0; step < 20; ++step) {
    first.step();
    second.step();
  }
  EXPECT_EQ(first.state().x, second.state().x);
  EXPECT_EQ(first.state().v, second.state().v);
}

}  // namespace
}  // namespace drape::test
