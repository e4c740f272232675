// Fields of acceleration by formula, compared with exactly known motions.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "drape/sim/effects/acceleration.hpp"
#include "drape/sim/simulation.hpp"
#include "sim/formula.hpp"
#include "tests/support/setups.hpp"

namespace drape::field_test {
namespace {

using test::NamedMethod;
using test::setup;

constexpr double mass = 0.5;

/// Makes isolated vertices at these positions, each with this velocity.
Cloth dots(const Vertices& places, const Eigen::RowVector3d& velocity) {
  Cloth cloth;
  cloth.positions = cloth.rest = places;
  cloth.velocities = velocity.replicate(places.rows(), 1);
  cloth.masses.setConstant(places.rows(), mass);
  return cloth;
}

Cloth dot(double x, double y, const Eigen::RowVector3d& velocity) {
  Vertices place(1, 3);
  place << x, y, 0;
  return dots(place, velocity);
}

SimulationSettings with(Cloth cloth, const NamedMethod& method, double step, const Field& field) {
  SimulationSettings settings = setup(std::move(cloth), method, step);
  settings.integrator.tolerance = 1e-10;
  settings.integrator.max_iterations = 1000;
  settings.effects = {field};
  return settings;
}

Eigen::RowVector3d place_after(double time, SimulationSettings settings) {
  Simulation simulation(std::move(settings));
  while (simulation.time() < time - 1e-9) simulation.step();
  return simulation.state().x.row(0);
}

class FieldMotion : public testing::TestWithParam<NamedMethod> {};
INSTANTIATE_TEST_SUITE_P(With, FieldMotion, testing::ValuesIn(test::all_methods), test::method_name);

// A spring that turns with ω about one of its ends pulls with k (l − L) = m ω² l.
TEST_P(FieldMotion, ASpringInACentrifugalFieldHasAKnownLength) {
  constexpr double k = 30, rest = 0.8, square_of_turning = 12;
  Vertices ends(2, 3);
  ends << 0, 0, 0, rest, 0, 0;
  Cloth cloth = dots(ends, {0, 0, 0});
  cloth.springs = {{.i = 0, .j = 1, .rest_length = rest, .stiffness = k}};
  cloth.pins = {0};
  SimulationSettings settings = with(std::move(cloth), GetParam(), 0.01,
                                     {.acceleration = {"12*x", "12*y", "0"}, .stiffness_bound = square_of_turning});
  settings.effects.add(Damping{.factor = 1e-4});
  Simulation simulation(settings);
  for (int i = 0; i < 1000; ++i) simulation.step();
  EXPECT_NEAR(simulation.state().x.row(1).norm(), k * rest / (k - mass * square_of_turning), 1e-6);
}

// A vertex on a circle around a centre that attracts with µ/r² returns after T = 2π √(r³/µ), up to the scheme's order.
TEST_P(FieldMotion, WhatCirclesAnAttractorComesBack) {
  constexpr double radius = 1.5, mu = 2;
  const double turn = 2 * std::numbers::pi * std::sqrt(radius * radius * radius / mu);
  const double speed = std::sqrt(mu / radius);
  const Field field{.acceleration = {"-2*x/(x*x+y*y+z*z)^1.5", "-2*y/(x*x+y*y+z*z)^1.5", "-2*z/(x*x+y*y+z*z)^1.5"},
                    .stiffness_bound = 2 * mu / (radius * radius * radius)};
  const auto error = [&](int steps) {
    const auto settings = with(dot(radius, 0, {0, speed, 0}), GetParam(), turn / steps, field);
    return (place_after(turn, settings) - Eigen::RowVector3d(radius, 0, 0)).norm();
  };
  const double coarse = error(400), fine = error(800);
  EXPECT_LT(coarse, GetParam().second_order() ? 0.01 : 0.2);
  EXPECT_GT(coarse, (GetParam().second_order() ? 3.5 : 1.8) * fine);
}

// v' = −c v: x = v₀/c (1 − e^(−ct)).
TEST_P(FieldMotion, DragByFormulaSlowsExponentially) {
  constexpr double c = 3, time = 0.5, start = 2;
  const Field field{.acceleration = {"-3*vx", "-3*vy", "-3*vz"}};
  const double expected = start / c * (1 - std::exp(-c * time));
  const auto error = [&](double h) {
    return std::abs(place_after(time, with(dot(0, 0, {start, 0, 0}), GetParam(), h, field))[0] - expected);
  };
  const double coarse = error(0.01);
  EXPECT_LT(coarse, GetParam().second_order() ? 1e-4 : 0.02);
  EXPECT_GT(coarse, (GetParam().second_order() ? 3.5 : 1.8) * error(0.005));
}

// a = sin t: x = t − sin t.
TEST_P(FieldMotion, MayDependOnTheTime) {
  const Field field{.acceleration = {"sin(t)", "0", "0"}};
  const double x = place_after(2, with(dot(0, 0, {0, 0, 0}), GetParam(), 0.001, field))[0];
  EXPECT_NEAR(x, 2 - std::sin(2), GetParam().second_order() ? 1e-5 : 2e-3);
}

TEST_P(FieldMotion, OfNumbersIsAWind) {
  SimulationSettings settings = test::homework(GetParam(), GetParam().is_explicit() ? 0.001 : 0.02, 180);
  settings.effects = {Field{.acceleration = {"1.5", "0", "-9.8"}}};
  Simulation field(settings);
  settings.effects = {Wind{.acceleration = {1.5, 0, -9.8}}};
  Simulation wind(settings);
  for (int i = 0; i < 20; ++i) {
    field.step();
    wind.step();
  }
  EXPECT_TRUE(test::same_bits(field.state().x, wind.state().x));
}

// The slope of a formula is unknown, and so is the safe step.
TEST(Field, OfThePlaceIsRefusedByExplicitMethodsWithoutABound) {
  const Field field{.acceleration = {"-5*x", "0", "0"}};
  for (const Method method : {Method::semi_implicit, Method::verlet}) {
    SimulationSettings settings = test::homework(method, 1e-4, 180);
    const auto problems = test::problems(field, settings);
    ASSERT_EQ(problems.size(), 1U);
    EXPECT_NE(problems[0].find("stiffness_bound"), std::string::npos) << problems[0];
    settings.effects = {field};
    EXPECT_ANY_THROW(Simulation{settings});
  }
  EXPECT_TRUE(test::problems(field, test::homework(Method::liu13, 0.02, 180)).empty());
  EXPECT_TRUE(test::problems(Field{.acceleration = {"-5*x", "0", "0"}, .stiffness_bound = 5},
                             test::homework(Method::verlet, 1e-4, 180))
                  .empty());
  EXPECT_TRUE(
      test::problems(Field{.acceleration = {"sin(t)", "-vx", "0"}}, test::homework(Method::verlet, 1e-4, 180)).empty());
}

TEST(Formula, MistakesAreNamedWithTheirPlace) {
  const auto problem = [](const std::string& formula) { return FormulaField::problem(formula).value_or(""); };
  for (const char* fine : {"0", "-x", "1e-3*sin(2*pi*t)", "x > 0 ? -1 : 1", "x == 0", "sqrt(x^2 + y^2)", "min(x, y)"}) {
    EXPECT_EQ(problem(fine), "") << fine;
  }
  EXPECT_EQ(problem("-x + vxx").substr(0, 54), "unknown name 'vxx' at its character 6; did you mean 'v");
  EXPECT_EQ(problem("sine(t)"), "unknown name 'sine' at its character 1; did you mean 'sin'?");
  EXPECT_EQ(problem("2*"), "it ends where a number, a name or '(' is expected");
  EXPECT_EQ(problem(""), "it ends where a number, a name or '(' is expected");
  EXPECT_EQ(problem("(x + 1"), "a ')' is missing");
  EXPECT_EQ(problem("x = 3"), "'=' at its character 3 assigns; to compare, write '=='");
  EXPECT_EQ(problem("x, y"), "expected one formula, found 2 separated by commas");
  for (const char* wrong : {"x +* y", "1 2", "sin()", "\"a\"", "x)", "sin(1, 2)", "1..2", "?:", "x ? 1"}) {
    EXPECT_NE(problem(wrong), "") << wrong;
  }
}

}  // namespace
}  // namespace drape::field_test
