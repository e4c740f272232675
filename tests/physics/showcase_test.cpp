// The showcase is physical: with self-collision, its cloth never passes through itself.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "drape/scene/scene.hpp"
#include "drape/sim/simulation.hpp"
#include "tests/support/intersections.hpp"

namespace drape::test {
namespace {

class Showcase : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Of, Showcase, testing::Values("body", "ground", "moving_pins", "self_collision"),
                         [](const auto& tested) { return std::string(tested.param); });

TEST_P(Showcase, NeverShowsAClothThatCutsThroughItself) {
  const std::filesystem::path folder = DRAPE_SOURCE_DIR "/scenes/showcase";
  const Scene scene = load_scene(folder / (std::string(GetParam()) + ".toml"));
  const auto& effects = scene.simulation.effects;
  ASSERT_TRUE(std::ranges::any_of(effects, [](const Effect& e) { return e.name() == "self_collision"; }));
  Simulation simulation(scene.simulation);
  for (std::int64_t step = 1; step <= scene.step_count(); ++step) {
    simulation.step();
    if (step % 160 != 0 && step != scene.step_count()) continue;
    EXPECT_EQ(self_intersections(scene.simulation.cloth.triangles, simulation.state().x), 0) << "after step " << step;
  }
}

}  // namespace
}  // namespace drape::test
