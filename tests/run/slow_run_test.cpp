// A long run reports early that it will be slow, why, and faster alternatives.

#include "run/progress.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "drape/sim/effects/acceleration.hpp"
#include "run/run_scene.hpp"

namespace drape {
namespace {

SimulationSettings hanging(Method method) {
  const Mesh square = make_grid(4, 4);
  return {.cloth = make_cloth(square, square, 1, 50, {0, 4}),
          .step = 0.002,
          .integrator = {.method = method},
          .effects = {Gravity{}}};
}

TEST(Pace, SaysHowLongAndWhy) {
  const auto text = [](const Pace& pace, const SimulationSettings& settings) { return describe_pace(pace, settings); };
  const Pace slow{.steps = 40, .left = 260, .seconds = 5, .simulated = 4.5, .iterations = 40 * 700, .substeps = 40};
  SimulationSettings settings = hanging(Method::liu13);
  EXPECT_EQ(text(slow, settings),
            "300 steps will take about 38 s: each takes 700 iterations; faster would be method = \"quasi-newton\"");
  settings.integrator = {.method = Method::quasi_newton, .tolerance = 1e-9};
  EXPECT_NE(text(slow, settings).find("faster would be a larger [integrator] tolerance"), std::string::npos);

  settings.integrator.tolerance.reset();
  EXPECT_TRUE(text(slow, settings).ends_with("faster would be [integrator] stop = \"error\" with tolerance = 0.0003"))
      << text(slow, settings);

  Pace other = slow;
  other.drawn = true;
  other.simulated = 1;
  EXPECT_NE(text(other, settings).find("most of it is drawing; faster would be a smaller [video] size"),
            std::string::npos);
  other = slow;
  other.substeps = 40 * 1000;
  settings.accuracy = 1e-6;
  EXPECT_NE(text(other, settings).find("[time] accuracy cuts each into 1000 substeps"), std::string::npos);
  settings = hanging(Method::verlet);
  other = slow;
  other.iterations = 0;
  other.left = 1'000'000;
  EXPECT_EQ(
      text(other, settings),
      "1000040 steps will take about 35 h: each takes 112 ms for 25 vertices; faster would be a longer [time] step "
      "with an implicit method, such as method = \"quasi-newton\"");
}

TEST(SlowRunWarning, TellsOnceAndOnlyOfLongRuns) {
  const auto told = [](const SlowRunWarning::Limits& limits) {
    std::vector<std::string> texts;
    Simulation simulation(hanging(Method::quasi_newton));
    SlowRunWarning slow(
        10, false, [&](const std::string& text) { texts.push_back(text); }, limits);
    const std::vector<StepObserver*> observers{&slow};
    run_steps(simulation, 10, observers, {});
    return texts;
  };
  EXPECT_TRUE(told({}).empty());
  EXPECT_TRUE(told({.after = 0, .long_run = 1e9}).empty());
  const std::vector<std::string> texts = told({.after = 0, .long_run = 0});
  ASSERT_EQ(texts.size(), 1U);
  EXPECT_TRUE(texts.front().starts_with("10 steps will take about 0 s: ")) << texts.front();
}

}  // namespace
}  // namespace drape
