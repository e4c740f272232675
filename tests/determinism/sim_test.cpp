#include <gtest/gtest.h>

#include <thread>

#include "drape/sim/effects/ground.hpp"
#include "drape/sim/simulation.hpp"
#include "tests/support/setups.hpp"

namespace drape::test {
namespace {

class Determinism : public testing::TestWithParam<NamedMethod> {};
INSTANTIATE_TEST_SUITE_P(Of, Determinism, testing::ValuesIn(all_methods), method_name);

constexpr int steps = 30;

SimulationSettings scene(Solver solver) {
  SimulationSettings settings = setup(cloth_of(make_grid(12, 12), 1, 60, {0, 12}), solver, 0.002);
  settings.cloth.velocities.rowwise() = Eigen::RowVector3d(0.5, 0, -6);  // reaches the sphere within the run
  settings.effects = {Gravity{}, homework_sphere(), homework_damping()};
  return settings;
}

State run(const SimulationSettings& settings) {
  Simulation simulation(settings);
  for (int step = 0; step < steps; ++step) simulation.step();
  return simulation.state();
}

void expect_same_bits(const State& a, const State& b) {
  EXPECT_EQ(a.step, b.step);
  EXPECT_TRUE(same_bits(a.x, b.x));
  EXPECT_TRUE(same_bits(a.v, b.v));
}

TEST_P(Determinism, SameSettingsGiveTheSameBits) {
  const SimulationSettings settings = scene(GetParam());
  expect_same_bits(run(settings), run(settings));
}

// A motion that is continued from any of its states goes on as if it had never stopped: nothing but the checkpoint
// influences a step. Divided into substeps, steps change between SDIRK2 and, in contact, backward Euler.
TEST_P(Determinism, AnyCheckpointContinuesWithTheSameBits) {
  for (const bool divided : {false, true}) {
    SimulationSettings settings = setup(cloth_of(make_grid(6, 6), 1, 100, {}), GetParam(), divided ? 0.02 : 0.005);
    settings.cloth.positions.col(2) += 0.3 * settings.cloth.positions.col(0);
    settings.cloth.positions.col(2).array() += 0.35;
    settings.cloth.velocities.col(2).setConstant(-2);
    if (divided) settings.accuracy = 1e-3;
    settings.effects = {Gravity{}, Ground{.friction = 0.1, .restitution = 0.95}};
    Simulation simulation(settings);
    for (int step = 0; step < steps; ++step) {
      const Simulation::Checkpoint checkpoint = simulation.checkpoint();
      simulation.step();
      Simulation continued(settings);
      continued.restore(checkpoint);
      continued.step();
      ASSERT_EQ(continued.hash(), simulation.hash()) << "step " << step << (divided ? ", divided" : "");
    }
  }
}

// Effects whose time is measured act one after another; otherwise an explicit step damps and moves in one pass.
TEST_P(Determinism, DampingWithinAStepHasTheBitsOfDampingAfterIt) {
  SimulationSettings settings = scene(GetParam());
  settings.effects = {Gravity{}, homework_damping()};
  Simulation within(settings), after(settings, Timing::effects);
  for (int step = 0; step < steps; ++step) {
    within.step();
    after.step();
  }
  expect_same_bits(within.state(), after.state());
}

// Substeps of a large grid are computed several at once, but not beside effects whose time is measured.
TEST(LargeGrid, TakesSubstepsAtOnceWithTheBitsOfSingleSubsteps) {
  for (const Method method : {Method::semi_implicit, Method::verlet}) {
    for (const int threads : {1, 3}) {
      SimulationSettings settings;
      settings.cloth = cloth_of(make_grid(250, 240), 1, 0.01, {0, 250});
      settings.step = 0.005;
      settings.integrator.method = method;
      settings.integrator.substeps = 11;
      settings.threads = threads;
      settings.effects = {Gravity{}, homework_damping()};
      Simulation at_once(settings), single(settings, Timing::effects);
      for (int step = 0; step < 2; ++step) {
        at_once.step();
        single.step();
      }
      expect_same_bits(at_once.state(), single.state());
    }
  }
}

TEST(LargeGrid, CutsStepsForAnAccuracyAlikeWithAnyNumberOfThreads) {
  for (const Method method : {Method::verlet, Method::quasi_newton}) {
    SimulationSettings settings;
    settings.cloth = cloth_of(make_grid(92, 92), 1, 10, {0, 92});
    settings.step = 0.005;
    settings.integrator.method = method;
    settings.accuracy = 1e-4;
    settings.effects = {Gravity{}};
    settings.threads = 1;
    Simulation alone(settings);
    settings.threads = 3;
    Simulation together(settings);
    EXPECT_EQ(alone.step().substeps, together.step().substeps);
    expect_same_bits(alone.state(), together.state());
    EXPECT_EQ(hash_of(alone.state()), hash_of(together.state()));
  }
}

TEST_P(Determinism, SimulationsThatTakeTurnsDoNotDisturbEachOther) {
  const SimulationSettings settings = scene(GetParam());
  SimulationSettings stiffer = settings;
  for (Spring& spring : stiffer.cloth.springs) spring.stiffness *= 3;
  Simulation a(settings), b(stiffer);
  for (int step = 0; step < steps; ++step) {
    a.step();
    b.step();
  }
  expect_same_bits(a.state(), run(settings));
  expect_same_bits(b.state(), run(stiffer));
  EXPECT_FALSE(same_bits(a.state().x, b.state().x));
}

TEST_P(Determinism, SimulationsInTwoThreadsDoNotDisturbEachOther) {
  const SimulationSettings settings = scene(GetParam());
  State first, second;
  {
    const std::jthread a([&] { first = run(settings); });
    const std::jthread b([&] { second = run(settings); });
  }
  const State alone = run(settings);
  expect_same_bits(first, alone);
  expect_same_bits(second, alone);
}

TEST_P(Determinism, ARestoredStateGoesOnAsTheOriginal) {
  const SimulationSettings settings = scene(GetParam());
  Simulation original(settings);
  for (int step = 0; step < steps / 2; ++step) original.step();
  Simulation restored(settings);
  restored.step();
  restored.restore(original.state());
  for (int step = steps / 2; step < steps; ++step) restored.step();
  expect_same_bits(restored.state(), run(settings));
}

}  // namespace
}  // namespace drape::test
