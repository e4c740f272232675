// Rebounds from a ground or a sphere have the coefficient's speed, for any step and method.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "drape/sim/effects/ground.hpp"
#include "drape/sim/simulation.hpp"
#include "tests/physics/contact_settings.hpp"

namespace drape::test::restitution {
namespace {

using Eigen::RowVector3d;
using Eigen::Vector3d;

constexpr double g = 9.8;           // default gravity [m/s²]
constexpr double thickness = 0.02;  // [m]
constexpr double fall = 0.5;        // [m]

class Restitution : public testing::TestWithParam<NamedMethod> {
 protected:
  SimulationSettings settings(Cloth cloth, double step) const {
    SimulationSettings result = contact_settings(GetParam(), std::move(cloth), step);
    result.integrator.tolerance = 1e-11;
    return result;
  }

  Ground ground(double restitution, double friction = 0.3) const {
    return {.thickness = thickness, .friction = friction, .restitution = restitution};
  }
};
INSTANTIATE_TEST_SUITE_P(With, Restitution, testing::ValuesIn(all_methods), method_name);

/// Makes a level, flat, unstrained sheet, `fall` above a ground's layer, soft enough for a step of 0.01 s.
Cloth falling_sheet() {
  Cloth cloth = cloth_of(make_grid(4, 4), 0.4, 2, {});
  cloth.positions.col(2).setConstant(thickness + fall);
  return cloth;
}

/// Greatest and least height of a vertex above its lowest turning point, from the first rise on [m].
struct Rebound {
  double highest = -1, lowest = 1;
};
Rebound rebound(const SimulationSettings& settings, double seconds) {
  Simulation simulation(settings);
  Rebound result;
  Eigen::VectorXd tops = Eigen::VectorXd::Constant(settings.cloth.vertex_count(), -1);
  bool down = false;
  while (simulation.time() < seconds) {
    const double before = simulation.state().x.col(2).minCoeff();
    simulation.step();
    const Eigen::VectorXd heights = simulation.state().x.col(2).array() - thickness;
    down = down || (before < thickness + fall / 2 && simulation.state().v.col(2).minCoeff() >= 0);
    if (down) tops = tops.cwiseMax(heights);
    result.lowest = std::min(result.lowest, heights.minCoeff());
  }
  result.highest = tops.maxCoeff();
  EXPECT_NEAR(tops.minCoeff(), result.highest, 1e-9) << "not all of the sheet bounces alike";
  return result;
}

TEST_P(Restitution, AFallingSheetRisesToItsSquareOfTheHeight) {
  for (const double step : {0.01, 0.002}) {
    for (const double e : {0.0, 0.25, 0.5, 0.75, 0.9, 1.0}) {
      SimulationSettings s = settings(falling_sheet(), step);
      s.effects.add(ground(e));
      const double share = rebound(s, 1).highest / fall;
      if (e > 0) {
        // The top of a parabola lies at most gh²/8 above the nearest step.
        EXPECT_NEAR(share, e * e, g * step * step / 4 / fall) << e << ", " << step;
      } else {
        EXPECT_LT(share, g * step * step / fall) << step;
      }
    }
  }
}

TEST_P(Restitution, AVertexRisesFromTheTopOfASphereToItsSquareOfTheHeight) {
  for (const double step : {0.01, 0.002}) {
    for (const double e : {0.25, 0.5, 0.9, 1.0}) {
      SimulationSettings s = settings(loose(RowVector3d(0, 0, thickness + fall)), step);
      s.effects.add(Sphere{
          .center = Vector3d(0, 0, thickness - 0.3), .radius = 0.2, .scale = 1.5, .friction = 0.3, .restitution = e});
      EXPECT_NEAR(rebound(s, 1).highest / fall, e * e, g * step * step / 4 / fall) << e << ", " << step;
    }
  }
}

// Contact compensates for the losses of Euler's steps: in ten seconds height is neither lost nor gained.
TEST_P(Restitution, OfOneNeitherGivesNorTakesHeight) {
  constexpr double step = 0.01;
  SimulationSettings s = settings(falling_sheet(), step);
  s.effects.add(ground(1, 0));
  Simulation simulation(s);
  double last = 0;
  for (int i = 0; i < 1000; ++i) {
    simulation.step();
    const double height = simulation.state().x.col(2).maxCoeff() - thickness;
    EXPECT_LE(height, fall + g * step * step / 8 + 1e-9);
    if (i >= 900) last = std::max(last, height);
  }
  EXPECT_NEAR(last, fall, g * step * step / 4);
}

// A sheet that lands on a corner vibrates. Velocities of Euler's steps are half a step old, so under gravity they
// conserve K + V − ½·h·Σ m g·v; the other schemes have current velocities.
TEST_P(Restitution, NeverGivesEnergyToASheetThatLandsOnACorner) {
  constexpr double step = 0.005;
  for (const double e : {0.5, 1.0}) {
    SimulationSettings s = settings(falling_sheet(), step);
    for (int i = 0; i < s.cloth.vertex_count(); ++i) {
      s.cloth.positions(i, 2) += 0.12 * s.cloth.positions(i, 0) + 0.07 * s.cloth.positions(i, 1);
    }
    for (Spring& spring : s.cloth.springs) {
      spring.rest_length = (s.cloth.positions.row(spring.i) - s.cloth.positions.row(spring.j)).norm();
    }
    s.effects.add(ground(e));
    s.integrator.tolerance = 1e-9;
    s.integrator.max_iterations = 1000;
    Simulation simulation(s);
    const auto total = [&] {
      const Energies now = simulation.energies();
      const double age = GetParam().second_order() ? 0 : step / 2;
      const double swing = -age * g * s.cloth.masses.dot(simulation.state().v.col(2));
      return now.kinetic + now.gravity + now.elastic + swing;
    };
    const double start = total();
    double most = start, least = start;
    while (simulation.time() < 2) {
      simulation.step();
      most = std::max(most, total());
      least = std::min(least, total());
    }
    const double height = s.cloth.masses.sum() * g * fall;
    EXPECT_LT(most - start, 1e-4 * height) << e;
    EXPECT_TRUE(e == 1 || least - start < -0.3 * height) << "nothing bounced at " << e;
  }
}

TEST_P(Restitution, EndsInRest) {
  SimulationSettings s = settings(falling_sheet(), 0.005);
  s.effects.add(ground(0.6));
  Simulation simulation(s);
  while (simulation.time() < 4) simulation.step();
  for (int i = 0; i < 100; ++i) {
    simulation.step();
    EXPECT_LT(simulation.state().v.cwiseAbs().maxCoeff(), 1e-6);
  }
  EXPECT_LT((simulation.state().x.col(2).array() - thickness).abs().maxCoeff(), 1e-6);
}

// Coulomb's cone holds for impacts: the tangential impulse is at most µ times the normal one, including the rebound.
TEST_P(Restitution, FrictionOfAnImpactIsCoulombs) {
  constexpr double e = 0.6, friction = 0.25, step = 0.01;
  // Euler's first step effectively starts a little higher.
  const double above = GetParam().second_order() ? 0 : g * step * step / 8;
  const double arrival = std::sqrt(2 * g * (fall + above));
  const double lost = friction * (1 + e) * arrival;
  for (const double speed : {3.0, 0.5}) {
    Cloth cloth = loose(RowVector3d(0, 0, thickness + fall));
    cloth.velocities.row(0) << 0.6 * speed, -0.8 * speed, 0;
    SimulationSettings s = settings(cloth, step);
    s.effects.add(ground(e, friction));
    Simulation simulation(s);
    while (simulation.time() < 0.4) simulation.step();
    const double expected = std::max(0.0, speed - lost);
    EXPECT_NEAR(simulation.state().v(0, 0), 0.6 * expected, 1e-9);
    EXPECT_NEAR(simulation.state().v(0, 1), -0.8 * expected, 1e-9);
  }
}

// On a slope the impact changes only the normal component.
TEST_P(Restitution, TurnsTheSpeedAcrossASlope) {
  constexpr double e = 0.5, step = 0.005;
  const Vector3d n = Vector3d(0.6, 0, 0.8);
  Cloth cloth = loose(RowVector3d(0.4 * n.transpose()));
  cloth.velocities.row(0) = -2 * n.transpose() + RowVector3d(0.8, 0.3, -0.6);
  SimulationSettings s = settings(cloth, step);
  Ground slope = ground(e, 0);
  slope.normal = n;
  slope.thickness = 0;
  s.effects = {slope};
  Simulation simulation(s);
  while (simulation.time() < 0.3) simulation.step();
  const RowVector3d expected = e * 2 * n.transpose() + RowVector3d(0.8, 0.3, -0.6);
  EXPECT_LT((simulation.state().v.row(0) - expected).norm(), 1e-9);
}

TEST_P(Restitution, IsRelativeToASphereThatMoves) {
  constexpr double e = 0.7;
  SimulationSettings s = settings(loose(RowVector3d(0, 0, 0)), 0.01);
  s.effects = {Sphere{
      .center = Vector3d(0, 0, -1.013), .radius = 1, .scale = 1, .restitution = e, .velocity = Vector3d(0, 0, 1.5)}};
  Simulation simulation(s);
  for (int i = 0; i < 10; ++i) simulation.step();
  EXPECT_NEAR(simulation.state().v(0, 2), 1.5 * (1 + e), 1e-9);
}

TEST_P(Restitution, DependsOnTheStateOnly) {
  SimulationSettings s = settings(falling_sheet(), 0.01);
  s.effects.add(ground(0.8));
  Simulation first(s), second(s);
  for (int i = 0; i < 25; ++i) first.step();
  const State middle = first.state();  // shortly before the impact
  for (int i = 0; i < 60; ++i) first.step();
  for (int i = 0; i < 40; ++i) second.step();
  second.restore(middle);
  for (int i = 0; i < 60; ++i) second.step();
  EXPECT_TRUE(same_bits(first.state().x, second.state().x));
  EXPECT_TRUE(same_bits(first.state().v, second.state().v));
}

}  // namespace
}  // namespace drape::test::restitution
