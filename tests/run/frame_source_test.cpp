#include "run/frame_source.hpp"

#include <gtest/gtest.h>

#include "tests/support/written_motion.hpp"

namespace drape::frame_source_tests {
namespace {

std::vector<Frame> pass(FrameSource& source) {
  std::vector<Frame> frames;
  source.pass([&](Frame frame) { frames.push_back(std::move(frame)); }, {});
  return frames;
}

void expect_same(const std::vector<Frame>& frames, const std::vector<Frame>& expected) {
  ASSERT_EQ(frames.size(), expected.size());
  for (std::size_t k = 0; k < frames.size(); ++k) {
    EXPECT_EQ(frames[k].time, expected[k].time);
    EXPECT_EQ(frames[k].positions, expected[k].positions);
    EXPECT_EQ(frames[k].velocities, expected[k].velocities);
    EXPECT_EQ(frames[k].energies->kinetic, expected[k].energies->kinetic);
  }
}

TEST(FrameSource, SimulatesOnceAndGivesTheSameFramesEachTime) {
  const test::SceneFolder folder;
  const LoadedScene scene = folder.load(test::moving_scene);
  const FilmExtent extent(scene.video, scene.simulation.step, scene.step_count(), {});
  for (const std::size_t memory : {std::size_t{0}, FrameTape::usual_memory}) {
    FrameSource source(scene, nullptr, extent, memory);
    EXPECT_FALSE(source.known());
    const std::vector<Frame> first = pass(source);
    EXPECT_EQ(first.size(), 9U);
    EXPECT_TRUE(source.known());
    expect_same(pass(source), first);
    expect_same(pass(source), first);
    EXPECT_EQ(source.statistics().steps(), 20) << "steps of all passes";
  }
}

TEST(FrameSource, GoesThroughAMotionThatDivergesUpToThere) {
  const test::SceneFolder folder;
  const LoadedScene scene =
      folder.load(test::moving_scene, {"integrator.method=\"semi-implicit\"", "integrator.allow_unstable=true",
                                       "cloth.stiffness=1e5", "time.duration=4"});
  const FilmExtent extent(scene.video, scene.simulation.step, scene.step_count(), {});
  FrameSource source(scene, nullptr, extent, 0);
  const std::vector<Frame> first = pass(source);
  EXPECT_LT(first.size(), 81U);
  EXPECT_FALSE(source.divergence().empty());
  expect_same(pass(source), first);
}

}  // namespace
}  // namespace drape::frame_source_tests
