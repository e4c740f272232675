#include <gtest/gtest.h>

#include <cmath>

#include "drape/sim/effects/ground.hpp"
#include "drape/sim/effects/moving_pins.hpp"
#include "drape/sim/simulation.hpp"
#include "sim/schemes/registry.hpp"
#include "sim/system.hpp"
#include "tests/support/setups.hpp"

namespace drape::test {
namespace {

using Eigen::RowVector3d;
using Eigen::Vector3d;

class MovingPins : public testing::TestWithParam<NamedMethod> {};
INSTANTIATE_TEST_SUITE_P(With, MovingPins, testing::ValuesIn(all_methods), method_name);

constexpr double h = 0.01;
const std::vector<Keyframe> path{{0, {0, 0, 0}}, {0.1, {0.1, 0, 0.05}}, {0.3, {0, -0.1, 0}}};

/// Makes a small cloth with all effects, including those that change velocities.
SimulationSettings stormy(Solver solver, std::vector<int> pins) {
  SimulationSettings settings = setup(cloth_of(make_grid(6, 6), 1, 40, std::move(pins)), solver, h);
  settings.effects = {Gravity{}, Ground{.height = -0.3, .friction = 0.4},
                      Sphere{.center = Vector3d(0, 0, -0.4), .radius = 0.3, .friction = 0.3}, Damping{.factor = 0.5}};
  return settings;
}

using Path = drape::MovingPins::Path;

drape::MovingPins moving(std::vector<int> pins, std::vector<Keyframe> keyframes, Path of = Path::offset) {
  return {.pins = std::move(pins), .keyframes = std::move(keyframes), .path = of};
}

TEST_P(MovingPins, AreAtTheirKeyframesExactlyWhenAStepEndsThere) {
  SimulationSettings settings = stormy(GetParam(), {0, 6, 48});
  settings.effects.add(moving({0, 6}, path));
  const Vertices start = settings.cloth.positions;
  Simulation simulation(settings);
  for (int step = 1; step <= 40; ++step) {
    simulation.step();
    const Vertices& x = simulation.state().x;
    for (const int pin : {0, 6}) {
      const Vector3d offset = step == 10 ? path[1].value : path[2].value;
      if (step == 10 || step >= 30) {
        ASSERT_EQ(x.row(pin), start.row(pin) + offset.transpose()) << "step " << step;
      }
      if (step == 5) {
        ASSERT_LT((x.row(pin) - start.row(pin) - RowVector3d(0.05, 0, 0.025)).norm(), 1e-15);
      }
    }
    ASSERT_EQ(x.row(48), start.row(48)) << "a pin that no table moves";
  }
}

TEST_P(MovingPins, APositionIsThatOfTheMiddleOfAll) {
  SimulationSettings settings = stormy(GetParam(), {0, 6});
  const auto others = settings.effects;
  settings.effects.add(moving({0, 6}, {{0.1, {3, 2, 1}}}, Path::position));
  Simulation simulation(settings);
  for (int step = 0; step < 10; ++step) simulation.step();
  EXPECT_EQ(simulation.state().x.row(0), RowVector3d(2, 2, 1));
  EXPECT_EQ(simulation.state().x.row(6), RowVector3d(4, 2, 1));

  settings.effects = others;
  settings.effects.add(moving({6}, {{0.1, {0.1, 0.2, 0.3}}}, Path::position));
  Simulation one(settings);
  for (int step = 0; step < 10; ++step) one.step();
  EXPECT_EQ(one.state().x.row(6), RowVector3d(0.1, 0.2, 0.3));
}

TEST_P(MovingPins, HaveTheVelocityOfTheirMotion) {
  SimulationSettings settings = stormy(GetParam(), {0, 6});
  settings.effects.add(moving({0, 6}, path));
  Simulation simulation(settings);
  for (int step = 0; step < 8; ++step) {
    simulation.step();
    EXPECT_LT((simulation.state().v.row(0) - RowVector3d(1, 0, 0.5)).norm(), 1e-12);
  }
  for (int step = 8; step < 35; ++step) simulation.step();
  EXPECT_EQ(simulation.state().v.row(0).norm(), 0) << "after the last keyframe";
}

// A cloth between uniformly moving pins: physics in their frame is as at rest.
TEST_P(MovingPins, ASteadyMotionIsAsGoodAsRest) {
  SimulationSettings rest = setup(cloth_of(make_grid(3, 3), 1, 30, {0, 3}), GetParam(), h);
  rest.integrator.tolerance = 1e-13;
  rest.integrator.max_iterations = 2000;
  rest.effects = {Gravity{}};
  SimulationSettings moved = rest;
  const Vector3d velocity(2, -1, 0.5);
  moved.cloth.velocities.rowwise() = velocity.transpose();
  moved.effects.add(moving({0, 3}, {{1, velocity}}));
  Simulation a(rest), b(moved);
  // The first step gives a pin its velocity; the free vertices have theirs from the start.
  for (int step = 0; step < 50; ++step) {
    a.step();
    b.step();
  }
  EXPECT_LT((a.state().x.rowwise() + 0.5 * velocity.transpose() - b.state().x).cwiseAbs().maxCoeff(), 1e-9);
}

TEST_P(MovingPins, FlyFreelyOnceTheyAreReleased) {
  // Pins only, without springs: a parabola from the moment of the release.
  Cloth cloth;
  cloth.positions = random_vertices(4, 3);
  cloth.velocities = Vertices::Zero(4, 3);
  cloth.masses = Eigen::VectorXd::Ones(4);
  cloth.pins = every(4);
  SimulationSettings settings = setup(cloth, GetParam(), h);
  settings.effects = {Gravity{}, drape::MovingPins{.pins = {0, 2}, .keyframes = {{1, {2, 0, 1}}}, .release = 0.3}};
  Simulation simulation(settings);
  for (int step = 0; step < 80; ++step) simulation.step();
  // 30 steps with the pin, then 50 of free fall: n(n+1)/2 h² g for Euler's, n²/2 h² g for the others.
  const int more = GetParam().second_order() ? 0 : 1;
  const RowVector3d expected = RowVector3d(2, 0, 1) * 0.8 + RowVector3d(0, 0, -9.8) * h * h * 50 * (50 + more) / 2;
  for (const int pin : {0, 2}) {
    EXPECT_LT((simulation.state().x.row(pin) - cloth.positions.row(pin) - expected).norm(), 1e-11);
  }
  for (const int pin : {1, 3}) EXPECT_EQ(simulation.state().x.row(pin), cloth.positions.row(pin));
}

TEST_P(MovingPins, AReleaseWithoutKeyframesDropsTheCloth) {
  SimulationSettings settings = stormy(GetParam(), {0, 6});
  settings.effects.add(drape::MovingPins{.pins = {0, 6}, .release = 0.0501});
  Simulation simulation(settings);
  for (int step = 0; step < 6; ++step) simulation.step();
  EXPECT_EQ(simulation.state().x.row(0), settings.cloth.positions.row(0)) << "the step that began at 0.05 s is pinned";
  simulation.step();
  EXPECT_LT(simulation.state().x(0, 2), settings.cloth.positions(0, 2));
}

// A step depends only on the state and its number, even across a release.
TEST_P(MovingPins, AStepDependsOnTheStateAlone) {
  SimulationSettings settings = stormy(GetParam(), {0, 6, 48});
  settings.effects.add(
      drape::MovingPins{.pins = {0, 6}, .keyframes = path, .interpolation = Interpolation::smooth, .release = 0.12});
  settings.effects.add(drape::MovingPins{.pins = {48}, .release = 0.2});
  Simulation through(settings);
  std::vector<State> states{through.state()};
  for (int step = 0; step < 30; ++step) {
    through.step();
    states.push_back(through.state());
  }
  Simulation jumping(settings);
  for (const std::size_t from : {25U, 5U, 12U, 11U, 20U, 19U, 0U}) {
    jumping.restore(states[from]);
    for (std::size_t step = from; step < from + 5; ++step) jumping.step();
    EXPECT_TRUE(same_bits(jumping.state().x, states[from + 5].x)) << "from step " << from;
    EXPECT_TRUE(same_bits(jumping.state().v, states[from + 5].v)) << "from step " << from;
  }
}

TEST(MovingPinsChecks, AStepMustBeSafeForTheClothAfterEveryReleaseToo) {
  SimulationSettings settings = setup(cloth_of(make_grid(2, 2), 1, 100, every(9)), Method::semi_implicit, 0.2);
  EXPECT_FALSE(stability_problem(settings, make_system(settings)));
  settings.effects = {drape::MovingPins{.pins = every(9), .release = 1}};
  EXPECT_TRUE(stability_problem(settings, make_system(settings)));
}

TEST(MovingPinsChecks, SayWhatIsWrong) {
  SimulationSettings settings = setup(cloth_of(make_grid(2, 2), 1, 100, {0, 2}), Method::liu13, 0.01);
  const auto said = [&](const Effect& effect) {
    const std::vector<std::string> found = problems(effect, settings);
    return found.empty() ? "" : found.front();
  };
  EXPECT_EQ(said(moving({0, 1}, path)), "pins: vertex 1 is not pinned; add it to [cloth] pins");
  EXPECT_EQ(said(drape::MovingPins{.pins = {0}}),
            ": give 'keyframes', 'rotations', 'follow' or 'release'; with none of them, nothing happens");
  EXPECT_EQ(said(drape::MovingPins{.pins = {0}, .turns = {{0, {0, 0, 10}}}}),
            "rotations: the pins start at their place in the cloth: give a rotation at 0 s a later time");
  EXPECT_EQ(
      said(moving({0}, {{0, {0, 0, 0.5}}, {1, {0, 0, 0}}})),
      "keyframes: the pins start at their place in the cloth, and the keyframe at 0 s is 0.5 m away from it: give "
      "it a later time");
  EXPECT_EQ(said(moving({0}, {{0, {-1, -1, 0}}, {1, {0, 0, 0}}}, Path::position)), "");
  settings.effects = {moving({0}, path), moving({0, 2}, path)};
  EXPECT_EQ(said(settings.effects[0]), "");
  EXPECT_EQ(said(settings.effects[1]), "pins: vertex 0 is in two tables [effects.moving_pins]: only one can move it");
}

}  // namespace
}  // namespace drape::test
