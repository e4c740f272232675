// Ground and spheres: rest, sliding, and being carried along.

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "drape/sim/effects/ground.hpp"
#include "drape/sim/simulation.hpp"
#include "tests/physics/contact_settings.hpp"

namespace drape::test {
namespace {

using Eigen::RowVector3d;
using Eigen::Vector3d;

constexpr double g = 9.8;           // default gravity [m/s²]
constexpr double thickness = 0.02;  // [m]

class Contact : public testing::TestWithParam<NamedMethod> {
 protected:
  SimulationSettings settings(Cloth cloth, double step) const {
    return contact_settings(GetParam(), std::move(cloth), step);
  }

  /// Makes a ground through the origin that descends by tan θ along x.
  Ground slope(double tangent, double friction) const {
    return {.normal = Vector3d(tangent, 0, 1), .thickness = thickness, .friction = friction};
  }
};
INSTANTIATE_TEST_SUITE_P(With, Contact, testing::ValuesIn(all_methods), method_name);

/// Return the unit normal of that slope, and its downhill direction.
Vector3d up_from(double tangent) { return Vector3d(tangent, 0, 1).normalized(); }
Vector3d down_along(double tangent) { return Vector3d(1, 0, -tangent).normalized(); }

/// Makes a vertex that lies on the slope.
Cloth resting_on(double tangent) { return loose((thickness * up_from(tangent)).transpose()); }

TEST_P(Contact, WhatRestsOnASlopeWithinTheFrictionConeStays) {
  SimulationSettings s = settings(resting_on(0.5), 0.01);
  s.effects.add(slope(0.5, 0.5 * (1 + 1e-9)));
  Simulation simulation(s);
  for (int step = 0; step < 300; ++step) simulation.step();
  EXPECT_LT((simulation.state().x - s.cloth.positions).norm(), 1e-12);
}

TEST_P(Contact, BeyondTheFrictionConeItSlides) {
  const double tangent = 0.5, friction = 0.3;
  SimulationSettings s = settings(resting_on(tangent), 0.01);
  s.effects.add(slope(tangent, friction));
  Simulation simulation(s);
  for (int step = 0; step < 100; ++step) simulation.step();
  const double sine = tangent / std::hypot(1, tangent), cosine = 1 / std::hypot(1, tangent);
  const double speed = g * (sine - friction * cosine);  // after one second
  // In its first step a second-order scheme still holds the vertex: the speed may lag by half a step's gain.
  const double held = GetParam().second_order() ? g * sine * 0.01 / 2 : 1e-9;
  EXPECT_NEAR((simulation.state().v.row(0) * down_along(tangent)).value(), speed, held);
  EXPECT_NEAR(simulation.state().v.row(0).norm(), speed, held);
}

TEST_P(Contact, ASlidingVertexIsStoppedAndNotTurnedBack) {
  SimulationSettings s = settings(resting_on(0), 0.01);
  s.cloth.velocities.row(0) << 1, -1, 0;
  s.effects.add(slope(0, 0.4));
  s.integrator.tolerance = 1e-14;  // [m] limits a slip in a step, 1e-12 m/s · h
  Simulation simulation(s);
  const double stop = std::sqrt(2.0) / (0.4 * g);  // [s]
  for (int step = 0; step < 20; ++step) simulation.step();
  EXPECT_NEAR(simulation.state().v.row(0).norm(), std::sqrt(2.0) - 0.4 * g * 0.2, 1e-9);
  for (int step = 20; step <= stop / 0.01 + 2; ++step) simulation.step();
  EXPECT_LT(simulation.state().v.row(0).norm(), 1e-12);
}

TEST_P(Contact, AClothStaysOnASlopeAsAWhole) {
  const double tangent = 0.3;
  Cloth cloth = cloth_of(make_grid(6, 6), 0.7, 60, {});
  // Along the slope, on the contact layer.
  const Vertices flat = cloth.positions;
  for (int i = 0; i < cloth.vertex_count(); ++i) {
    cloth.positions.row(i) =
        (flat(i, 0) * down_along(tangent) + flat(i, 1) * Vector3d::UnitY() + thickness * up_from(tangent)).transpose();
  }
  SimulationSettings s = settings(cloth, 0.005);
  s.effects.add(slope(tangent, 0.31));
  Simulation simulation(s);
  for (int step = 0; step < 100; ++step) simulation.step();
  EXPECT_LT((simulation.state().x - cloth.positions).cwiseAbs().maxCoeff(), 1e-9);
}

TEST_P(Contact, PinsAreNotMovedByFriction) {
  Cloth cloth = resting_on(0.5);
  cloth.pins = {0};
  SimulationSettings s = settings(cloth, 0.01);
  s.effects.add(slope(0.5, 0.8));
  Simulation simulation(s);
  for (int step = 0; step < 10; ++step) simulation.step();
  EXPECT_TRUE(same_bits(simulation.state().x, cloth.positions));
}

/// Makes a huge ball that moves along x under a vertex resting on it.
Sphere moving_floor(double friction) {
  return {.center = Vector3d(0, 0, -1e4),
          .radius = 1e4,
          .scale = 1,
          .friction = friction,
          .restitution = 0,
          .velocity = Vector3d(1.5, 0, 0)};
}

TEST_P(Contact, AMovingSphereCarriesAlongWhatLiesOnIt) {
  SimulationSettings s = settings(loose(RowVector3d(0, 0, 0)), 0.01);
  s.effects.add(moving_floor(0.5));
  Simulation simulation(s);
  for (int step = 0; step < 10; ++step) simulation.step();
  EXPECT_NEAR(simulation.state().v(0, 0), 0.5 * g * 0.1, 1e-4);  // µ g t
  for (int step = 10; step < 60; ++step) simulation.step();
  EXPECT_NEAR(simulation.state().v(0, 0), 1.5, 1e-4);

  s.effects = {Gravity{}, moving_floor(0)};
  Simulation slippery(s);
  for (int step = 0; step < 60; ++step) slippery.step();
  EXPECT_NEAR(slippery.state().v(0, 0), 0, 1e-3);
}

// A push is evaluated at the start of a step, or at its middle by a second-order scheme.
TEST_P(Contact, ASphereThatPushesDoesSoFromWhereItIsAtItsTime) {
  SimulationSettings s = settings(loose(RowVector3d(0, 0, 0)), 0.01);
  const double then = GetParam().second_order() ? 0.015 : 0.01;
  s.effects = {Sphere{.radius = 0.5,
                      .scale = 1,
                      .stiffness = 4000,
                      .keyframes = {{then - 0.004, {-5, 0, 0}}, {then, {-0.45, 0, 0}}, {then + 0.004, {-5, 0, 0}}}}};
  Simulation simulation(s);
  simulation.step();
  EXPECT_LT(simulation.state().v(0, 0), 0.1);
  simulation.step();
  EXPECT_GT(simulation.state().v(0, 0), 0.1);
}

/// Returns the middle of a floor that accelerates sideways and rises.
Vector3d accelerating_place(double time) { return {3 * time + 10 * time * time, 0, time - 1e4}; }

/// Steps a vertex that lies on that floor, a huge ball, with the floor's initial velocity, and sticks to it.
void expect_carried(SimulationSettings s) {
  constexpr int steps = 20;
  std::vector<Keyframe> path;
  for (int k = 0; k <= steps; ++k) path.push_back({k * s.step, accelerating_place(k * s.step)});
  s.cloth.velocities.row(0) << 3, 0, 1;
  s.effects.add(Sphere{.radius = 1e4, .scale = 1, .friction = 100, .keyframes = path});
  Simulation simulation(s);
  for (std::size_t k = 0; k < steps; ++k) {
    simulation.step();
    const Vector3d way = path[k + 1].value - path[k].value;
    EXPECT_NEAR(simulation.state().v(0, 0), way[0] / s.step, 1e-4) << "step " << k;
  }
}

TEST_P(Contact, WhatSticksToAnAcceleratingSphereHasItsVelocityInTheSameStep) {
  expect_carried(settings(loose(RowVector3d(0, 0, 0)), 0.01));
}

// Semi-implicit Euler moves with the velocities after contact: damping comes before it.
TEST(SemiImplicitContact, HoldsWhatIsDamped) {
  SimulationSettings s = setup(loose(RowVector3d(0, 0, 0)), Method::semi_implicit, 0.01);
  s.effects = {Gravity{}, Damping{.factor = 0.2}};
  expect_carried(s);
}

TEST_P(Contact, AnEffectlessContactLeavesTheMotionAlone) {
  SimulationSettings s = settings(cloth_of(make_grid(4, 4), 1, 50, {0}), 0.01);
  Simulation without(s);
  s.effects.add(Ground{.height = -50});
  Simulation with(s);
  for (int step = 0; step < 20; ++step) {
    without.step();
    with.step();
  }
  EXPECT_LT((with.state().x - without.state().x).cwiseAbs().maxCoeff(), 1e-9);
}

}  // namespace
}  // namespace drape::test
