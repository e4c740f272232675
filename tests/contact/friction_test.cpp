// Coulomb's law on a slope: a cloth that friction holds does not creep, and a sliding one accelerates like a block.

#include <gtest/gtest.h>

#include <cmath>

#include "tests/contact/contact_setup.hpp"

namespace drape::test {
namespace {

using Eigen::RowVector3d;
using Eigen::Vector3d;

constexpr double friction = 0.5;

INSTANTIATE_TEST_SUITE_P(With, Solved, testing::ValuesIn(contact_methods), method_name);

struct Slope {
  Vector3d up, down;  // across it, and along it
  double steepness;   // g times the sine of its angle, less the deceleration by friction [m/s²]
};
Slope slope_of(double tangent) {
  const double cosine = 1 / std::sqrt(1 + tangent * tangent), sine = tangent * cosine;
  return {{sine, 0, cosine}, {cosine, 0, -sine}, g * (sine - friction * cosine)};
}

/// Makes a sheet that lies on the slope at rest.
Cloth lying(const Slope& slope) {
  Mesh mesh = level_square(0.5, 4, 0);
  for (Eigen::Index i = 0; i < mesh.positions.rows(); ++i) {
    const RowVector3d p = mesh.positions.row(i);
    mesh.positions.row(i) = (p.x() * slope.down + p.y() * Vector3d::UnitY() + distance * slope.up).transpose();
  }
  return plain_sheet(mesh);
}

SimulationSettings on_slope(SimulationSettings settings, const Slope& slope) {
  Ground ground = solved_ground(friction);
  ground.normal = slope.up;
  settings.effects.add(ground);
  return settings;
}

/// Returns the speed after 0.1 s [m/s].
double creep(const SimulationSettings& settings) {
  Simulation simulation(settings);
  run(simulation, 0.1);
  const Vertices from = simulation.state().x;
  run(simulation, 0.3);
  return (simulation.state().x - from).rowwise().norm().maxCoeff() / 0.2;
}

TEST_P(Solved, WhatLiesOnASlopeWithinTheConeDoesNotCreep) {
  const Slope slope = slope_of(0.99 * friction);
  for (const double step : {0.002, 0.01}) {
    EXPECT_LT(creep(exact(on_slope(settings(lying(slope), step), slope))), 1e-6) << step;
  }
}

TEST_P(Solved, WhatLiesOnASlopeWithinTheConeDoesNotCreepByDefault) {
  const Slope slope = slope_of(0.99 * friction);
  for (const double step : {0.002, 0.01}) {
    EXPECT_LT(creep(on_slope(settings(lying(slope), step), slope)), 1e-5) << step;
  }
}

/// Checks the acceleration after 0.1 s down a slope `part` times as steep as friction can hold.
void expect_to_slide(SimulationSettings settings, double part, double error) {
  const Slope slope = slope_of(part * friction);
  Simulation simulation(std::move(settings));
  constexpr double from = 0.1, to = 0.3;
  const auto speed = [&] { return mean_of(simulation.cloth(), simulation.state().v).dot(slope.down.transpose()); };
  run(simulation, from);
  const double before = speed();
  run(simulation, to);
  EXPECT_NEAR((speed() - before) / (to - from), slope.steepness, error) << part << ", " << simulation.settings().step;
  EXPECT_NEAR(before, slope.steepness * from, error * from) << part << ", " << simulation.settings().step;
}

TEST_P(Solved, WhatSlidesDownASlopeAcceleratesAsABlock) {
  for (const double step : {0.002, 0.01}) {
    for (const double part : {1.01, 1.5}) {
      const Slope slope = slope_of(part * friction);
      const double error = part < 1.1 ? 0.002 * g : 0.01 * slope.steepness;
      expect_to_slide(exact(on_slope(settings(lying(slope), step), slope)), part, error);
    }
  }
}

TEST_P(Solved, WhatSlidesDownASlopeAcceleratesAsABlockByDefault) {
  for (const double step : {0.002, 0.01}) {
    const Slope slope = slope_of(1.5 * friction);
    expect_to_slide(on_slope(settings(lying(slope), step), slope), 1.5, 0.05 * slope.steepness);
  }
}

}  // namespace
}  // namespace drape::test
