// A step that is stopped leaves the state as if it had not begun, wherever it stops.

#include <gtest/gtest.h>

#include <vector>

#include "drape/sim/effects/air.hpp"
#include "drape/sim/effects/bending.hpp"
#include "drape/sim/effects/body.hpp"
#include "drape/sim/effects/ground.hpp"
#include "drape/sim/effects/moving_pins.hpp"
#include "drape/sim/effects/self_collision.hpp"
#include "drape/sim/effects/strain_limit.hpp"
#include "drape/sim/simulation.hpp"
#include "tests/support/random.hpp"
#include "tests/support/setups.hpp"

namespace drape::test {
namespace {

class Stopped : public testing::TestWithParam<NamedMethod> {};
INSTANTIATE_TEST_SUITE_P(Of, Stopped, testing::ValuesIn(all_methods), method_name);

constexpr int some_steps = 5;

/// A stop request at the k-th query only; counts queries.
struct Question {
  long asked = 0, yes_at = 0;

  [[nodiscard]] Stop stop() {
    return Stop([this] { return ++asked == yes_at; });
  }
};

/// Makes a falling cloth with each possible effect alone, and with all of them.
std::vector<SimulationSettings> cloths(Solver solver) {
  const MovingPins pins{.pins = {0, 6}, .keyframes = {{.time = 0.02, .value = {0, 0, 0.1}}}, .release = 0.015};
  const std::vector<Effect> all{
      Air{.velocity = {1, 2, 0}},
      Bending{.rigidity = 1e-4},
      pins,
      homework_sphere(),
      Ground{.height = -0.05},
      Body{.box = Eigen::Vector3d(0.4, 0.4, 0.1), .center = Eigen::Vector3d(0, 0, -0.08)},
      StrainLimit{.max_stretch = 1.01},
      SelfCollision{.thickness = 0.1},
      homework_damping(),
  };
  SimulationSettings bare = setup(cloth_of(make_grid(6, 6), 1, 50, {0, 6}), solver, 0.005);
  bare.cloth.velocities.rowwise() = Eigen::RowVector3d(0, 0, -8);
  bare.effects.add(Gravity{});
  std::vector<SimulationSettings> result{bare};
  SimulationSettings every = bare;
  for (const Effect& effect : all) {
    result.push_back(bare);
    result.back().effects.add(effect);
    every.effects.add(effect);
  }
  result.push_back(every);
  result.push_back(bare);
  result.back().accuracy = 1e-3;
  result.back().integrator.tolerance.reset();
  if (is_explicit(bare.integrator.method)) {
    result.push_back(bare);
    result.back().integrator.substeps = 3;
  }
  return result;
}

void expect_bits(const State& state, const State& expected) {
  EXPECT_EQ(state.step, expected.step);
  EXPECT_TRUE(same_bits(state.x, expected.x));
  EXPECT_TRUE(same_bits(state.v, expected.v));
}

/// Returns the states of a motion from its start.
std::vector<State> motion_of(const SimulationSettings& settings, const Stop& stop) {
  Simulation simulation(settings, Timing::none, stop);
  std::vector<State> states{simulation.state()};
  for (int step = 0; step < some_steps; ++step) {
    simulation.step();
    states.push_back(simulation.state());
  }
  return states;
}

TEST_P(Stopped, WhereverItIsTheStateIsThatBeforeTheStepAndTheRestTheSame) {
  const std::vector<SimulationSettings> all = cloths(GetParam());
  for (std::size_t i = 0; i < all.size(); ++i) {
    // This run computes the safe step, which also queries, so that it is known afterwards.
    const State last = motion_of(all[i], {}).back();
    Question never;
    const std::vector<State> states = motion_of(all[i], never.stop());
    expect_bits(states.back(), last);
    for (long k = 1; k <= never.asked; k += 1 + 10 * k / tries(40)) {
      SCOPED_TRACE(testing::Message() << "cloth " << i << ", asked " << k << " of " << never.asked << " times");
      Question question{.asked = 0, .yes_at = k};
      std::optional<Simulation> simulation;
      int interrupted = 0;
      const auto until_done = [&](const auto& work) {
        try {
          work();
        } catch (const Interrupted&) {
          ++interrupted;
          if (simulation) expect_bits(simulation->state(), states[static_cast<std::size_t>(simulation->state().step)]);
          work();
        }
      };
      until_done([&] { simulation.emplace(all[i], Timing::none, question.stop()); });
      for (int step = 0; step < some_steps; ++step) until_done([&] { simulation->step(); });
      EXPECT_EQ(interrupted, 1);
      expect_bits(simulation->state(), states.back());
    }
  }
}

TEST_P(Stopped, AStepIsTakenBack) {
  for (const SimulationSettings& settings : cloths(GetParam())) {
    Question never;
    Simulation simulation(settings, Timing::none, never.stop());
    simulation.step();
    const State before = simulation.state();
    simulation.step();
    const State after = simulation.state();
    simulation.undo_step();
    if (simulation.state().step == after.step) continue;  // a step that cannot be interrupted
    expect_bits(simulation.state(), before);
    simulation.step();
    expect_bits(simulation.state(), after);
  }
}

// Long computations query often: in every iteration…
TEST_P(Stopped, EveryIterationOfASolverAsks) {
  SimulationSettings settings = homework(GetParam(), GetParam().is_explicit() ? 0.001 : 0.02, 500);
  settings.effects.add(Gravity{});
  Question never;
  Simulation simulation(settings, Timing::none, never.stop());
  for (int step = 0; step < some_steps; ++step) {
    const long before = never.asked;
    const StepReport report = simulation.step();
    EXPECT_GT(never.asked - before, report.iterations);
  }
}

// …and sweep.
TEST(StoppedFilters, EverySweepAndPassAsks) {
  const auto asked_in_a_step = [](const Effect& effect) {
    SimulationSettings settings = setup(cloth_of(make_grid(6, 6), 1, 50, {0, 6}), Method::semi_implicit, 0.005);
    settings.cloth.velocities.rowwise() = Eigen::RowVector3d(0, 0, -20);
    settings.effects.add(effect);
    Question never;
    Simulation simulation(settings, Timing::none, never.stop());
    const long before = never.asked;
    simulation.step();
    return never.asked - before;
  };
  EXPECT_GE(asked_in_a_step(StrainLimit{.max_stretch = 1, .iterations = 70, .tolerance = 1e-300}), 70);
  Body body{.box = Eigen::Vector3d(3, 3, 0.1), .center = Eigen::Vector3d(0, 0, -0.07)};
  EXPECT_GE(asked_in_a_step(body), 3) << "a round, its passes and the search after it";
}

/// Setting up a large cloth takes long and can be stopped too.
TEST(StoppedSetUp, IsInterruptedToo) {
  for (const Method method : {Method::semi_implicit, Method::liu13}) {
    Question question{.asked = 0, .yes_at = 2};
    EXPECT_THROW(Simulation(homework(method, 0.001, 50), Timing::none, question.stop()), Interrupted);
  }
}

}  // namespace
}  // namespace drape::test
