// The default method, and steps divided into substeps.

#include "drape/sim/schemes/method_choice.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "drape/sim/effects/acceleration.hpp"
#include "drape/sim/effects/air.hpp"
#include "drape/sim/effects/damping.hpp"
#include "drape/sim/effects/ground.hpp"
#include "drape/sim/effects/moving_pins.hpp"
#include "drape/sim/effects/self_collision.hpp"
#include "drape/sim/simulation.hpp"
#include "sim/stability.hpp"
#include "sim/system.hpp"
#include "tests/support/setups.hpp"

namespace drape::test {
namespace {

SimulationSettings unnamed(double step, double stiffness = 180) {
  SimulationSettings settings = homework(Method::liu13, step, stiffness);
  settings.integrator = {};
  return settings;
}

TEST(MethodChoice, IsVerletInTheFewestStableSubsteps) {
  for (const double step : {0.0005, 0.01, 0.02, 0.05}) {
    const SimulationSettings settings = unnamed(step);
    const double ratio = step / safe_step(make_system(settings));
    const MethodChoice choice = choose_method(settings);
    EXPECT_EQ(choice.method, Method::verlet);
    EXPECT_EQ(choice.substeps, static_cast<int>(std::ceil(ratio))) << step;
    EXPECT_LT(choice.verlet, choice.quasi_newton);
    const Simulation simulation(settings);
    EXPECT_EQ(simulation.settings().integrator.method, Method::verlet);
    EXPECT_EQ(simulation.settings().integrator.substeps, choice.substeps);
  }
}

TEST(MethodChoice, IsQuasiNewtonWhereSpringsAreTooStiffForShortSteps) {
  EXPECT_EQ(choose_method(unnamed(0.02, 1e9)).method, Method::quasi_newton);
  EXPECT_EQ(choose_method(unnamed(0.02, 1e17)).method, Method::quasi_newton);
}

TEST(MethodChoice, IsQuasiNewtonWhereVerletCannotHaveWhatActs) {
  SimulationSettings steep = unnamed(0.01);
  steep.effects.add(Field{.acceleration = {"-x", "0", "0"}});
  EXPECT_EQ(choose_method(steep).method, Method::quasi_newton);
  steep = unnamed(0.01);
  steep.effects.add(Field{.acceleration = {"-x", "0", "0"}, .stiffness_bound = 1});
  EXPECT_EQ(choose_method(steep).method, Method::verlet);
}

// The dashpots of a verlet step are evaluated the more often, the longer their relaxation time.
TEST(MethodChoice, CountsWhatInternalDampingCosts) {
  const auto choice = [](double time) {
    SimulationSettings settings = unnamed(0.02);
    if (time > 0) settings.effects.add(InternalDamping{.relaxation_time = time});
    return choose_method(settings);
  };
  EXPECT_EQ(choice(0.02).method, Method::verlet);
  EXPECT_EQ(choice(0.02).substeps, choice(0).substeps) << "the safe step is that without dashpots";
  EXPECT_GT(choice(0.02).verlet, 2 * choice(0).verlet);
  EXPECT_GT(choice(2).verlet, 5 * choice(0.02).verlet);
  EXPECT_EQ(choice(20).method, Method::quasi_newton);
}

TEST(MethodChoice, IsSharedByRunsThatAreCompared) {
  const auto choice = [](Method method, double verlet, double quasi_newton, bool only) {
    return MethodChoice{.method = method, .verlet = verlet, .quasi_newton = quasi_newton, .reason = {}, .only = only};
  };
  const MethodChoice cheap = choice(Method::verlet, 1, 2, false), stiff = choice(Method::quasi_newton, 5, 3, false),
                     forced = choice(Method::verlet, 9, 1, true), barred = choice(Method::quasi_newton, 1, 9, true);
  const auto shared = [](std::vector<MethodChoice> choices) { return shared_method(choices); };
  EXPECT_EQ(shared({cheap, cheap}), Method::verlet);
  EXPECT_EQ(shared({cheap, stiff}), Method::quasi_newton) << "6 s against 5 s";
  EXPECT_EQ(shared({cheap, cheap, stiff}), Method::verlet) << "7 s each; the more accurate";
  EXPECT_EQ(shared({stiff, stiff, forced}), Method::verlet);
  EXPECT_EQ(shared({cheap, barred}), Method::quasi_newton);
  EXPECT_EQ(shared({forced, barred}), std::nullopt);
}

TEST(MethodChoice, FollowsFromWhatSettingsSayOfTheSolve) {
  EXPECT_EQ(with_method(unnamed(0.01)).integrator.method, Method::verlet);
  SimulationSettings settings = unnamed(0.01);
  settings.integrator.tolerance = 1e-3;
  EXPECT_EQ(with_method(settings).integrator.method, Method::quasi_newton);
  settings = unnamed(0.01);
  settings.integrator.scheme = TimeScheme::sdirk2;
  EXPECT_EQ(with_method(settings).integrator.method, Method::quasi_newton);
  settings = unnamed(0.01);
  settings.integrator.linear_solver = LinearSolver::cholesky;
  EXPECT_EQ(with_method(settings).integrator.method, Method::implicit);
}

TEST(MethodChoice, IsTheSameForAnAccuracy) {
  SimulationSettings settings = unnamed(0.01);
  settings.accuracy = 1e-3;
  const SimulationSettings named = with_method(settings);
  EXPECT_EQ(named.integrator.method, Method::verlet);
  EXPECT_FALSE(named.integrator.substeps.has_value());  // determined in every step
}

/// A power of two of substeps gives the bits of short steps, because all times are then equal.
TEST(Substeps, AreStepsToTheBit) {
  for (const Method method : {Method::verlet, Method::semi_implicit}) {
    SimulationSettings whole = homework(method, 1.0 / 64, 180);
    whole.integrator = {.method = method, .substeps = 16};
    whole.effects.add(Air{.velocity = Eigen::Vector3d(1, 2, 0)});
    whole.effects.add(Field{.acceleration = {"sin(9*t)", "t", "0"}});
    whole.effects.add(Ground{.height = -1});
    whole.effects.add(SelfCollision{});
    whole.effects.add(MovingPins{.pins = {0}, .keyframes = {{0, {0, 0, 0}}, {1, {0.2, 0.4, 0}}}, .release = 0.125});
    SimulationSettings parts = whole;
    parts.step /= 16;
    parts.integrator.substeps.reset();
    Simulation a(whole), b(parts);
    for (int step = 0; step < 10; ++step) {
      const StepReport report = a.step();
      EXPECT_EQ(report.substeps, 16);
      for (int part = 0; part < 16; ++part) b.step();
      ASSERT_TRUE(same_bits(a.state().x, b.state().x)) << step;
      ASSERT_TRUE(same_bits(a.state().v, b.state().v)) << step;
      EXPECT_DOUBLE_EQ(a.time(), b.time());
    }
    EXPECT_EQ(a.state().step, 10);
  }
}

TEST(Substeps, ThatAreTooLongAreRefused) {
  SimulationSettings settings = homework(Method::verlet, 0.02, 180);
  settings.integrator = {.method = Method::verlet, .substeps = choose_method(unnamed(0.02)).substeps};
  EXPECT_NO_THROW(Simulation{settings});
  settings.integrator.substeps = *settings.integrator.substeps - 1;
  EXPECT_THROW(Simulation{settings}, UsageError);
}

}  // namespace
}  // namespace drape::test
