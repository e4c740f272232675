#include <gtest/gtest.h>

#include <array>

#include "run/run_scene.hpp"
#include "run/statistics.hpp"
#include "tests/support/setups.hpp"

namespace drape {
namespace {

/// Observers see whole steps only, even if a stop arrives while one of them evaluates a finished step's error. A
/// resumed run therefore sees every step once.
TEST(RunSteps, InterruptedAnywhereGoOnAsIfNothingWas) {
  SimulationSettings settings = test::setup(test::cloth_of(make_grid(4, 4), 1, 50, {0, 4}), Method::implicit, 0.01);
  settings.effects.add(Gravity{});
  constexpr int steps = 129;  // the error of the 128th is evaluated
  struct Run {
    long asked = 0;
    Statistics statistics;
    State end;
  };
  const auto run = [&](long yes_at) {
    Run result;
    Simulation simulation(settings, Timing::none, Stop([&] { return ++result.asked == yes_at; }));
    const std::array<StepObserver*, 1> observers{&result.statistics};
    for (int calls = 0; simulation.state().step < steps && calls < 2; ++calls) {
      run_steps(simulation, steps, observers, {});
      EXPECT_EQ(result.statistics.steps(), simulation.state().step);
    }
    result.end = simulation.state();
    return result;
  };
  const Run whole = run(0);
  const auto errors = whole.statistics.exactness().errors();
  ASSERT_TRUE(errors);
  for (long k = whole.asked * 9 / 10; k <= whole.asked; ++k) {
    const Run parts = run(k);
    EXPECT_EQ(parts.statistics.steps(), steps) << k;
    EXPECT_EQ(parts.statistics.mean_iterations(), whole.statistics.mean_iterations()) << k;
    ASSERT_TRUE(parts.statistics.exactness().errors()) << k;
    EXPECT_EQ(parts.statistics.exactness().errors()->mean, errors->mean) << k;
    EXPECT_TRUE(test::same_bits(parts.end.x, whole.end.x)) << k;
  }
}

}  // namespace
}  // namespace drape
