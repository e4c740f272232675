#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "drape/core/error.hpp"
#include "run/frame_source.hpp"
#include "run/run_scene.hpp"
#include "tests/support/setups.hpp"

namespace drape {
namespace {

Video video(double fps, double speed) {
  Video v;
  v.fps = fps;
  v.speed = speed;
  return v;
}

std::vector<Frame> sampled(Simulation& simulation, const FilmExtent& extent,
                           FrameContents contents = FrameContents::places) {
  std::vector<Frame> frames;
  FrameSampler sampler(
      extent, [&](Frame frame) { frames.push_back(std::move(frame)); }, contents);
  const std::array<StepObserver*, 1> observers{&sampler};
  run_steps(simulation, extent.steps, observers, {});
  return frames;
}

TEST(FilmExtent, HasAFrameAtBothEndsOfTheMotion) {
  const FilmExtent extent(video(25, 1), 0.02, 417, std::nullopt);
  EXPECT_EQ(extent.frames.first, 0);
  EXPECT_EQ(extent.frames.last, 208);  // 8.32 s; the next would be at 8.36 s, after the motion's 8.34 s
  EXPECT_EQ(FilmExtent(video(25, 1), 0.02, 416, std::nullopt).frames.last, 208);
  EXPECT_EQ(FilmExtent(video(25, 1), 0.02, 415, std::nullopt).frames.last, 207);
}

TEST(FilmExtent, PlaysTwiceAsFastWithHalfTheFrames) {
  EXPECT_EQ(FilmExtent(video(25, 2), 0.001, 8000, std::nullopt).frames.count(), 101);
}

TEST(FilmExtent, SimulatesNoFurtherThanTheLastFrameNeeds) {
  EXPECT_EQ(FilmExtent(video(25, 1), 0.02, 417, FrameRange{3, 10}).steps, 20);
  EXPECT_EQ(FilmExtent(video(30, 1), 0.02, 417, FrameRange{3, 10}).steps, 17);  // 0.3333 s lies within step 17
}

TEST(FilmExtent, RefusesFramesAfterTheEnd) {
  EXPECT_THROW(FilmExtent(video(25, 1), 0.02, 417, FrameRange{0, 209}), UsageError);
}

TEST(FilmExtent, CountsStepsWhereItIsTold) {
  const FilmExtent extent(video(25, 2), 0.02, 417, std::nullopt, 10);
  EXPECT_EQ(extent.frames.last, 41);
  EXPECT_EQ(extent.steps, 417);  // the last seven have no frame, but a record of their own
  EXPECT_EQ(extent.time(41), 410 * 0.02);
  EXPECT_EQ(extent.seconds_per_frame, 0.2);
  EXPECT_EQ(FilmExtent(video(25, 1), 0.02, 417, FrameRange{3, 10}, 7).steps, 70);
  EXPECT_THROW(FilmExtent(video(25, 1), 0.02, 417, FrameRange{0, 42}, 10), UsageError);
}

TEST(FrameSampler, TakesAStepsOwnBitsWhereAFrameFallsOnIt) {
  Simulation simulation(test::homework(Method::liu13, 0.02, 180)), again(test::homework(Method::liu13, 0.02, 180));
  const auto frames = sampled(simulation, FilmExtent(video(25, 1), 0.02, 20, std::nullopt));
  ASSERT_EQ(frames.size(), 11u);
  for (int step = 0; step < 20; ++step) again.step();
  EXPECT_EQ(frames.back().positions, again.state().x);
  EXPECT_EQ(frames.front().positions, again.cloth().positions);
}

TEST(FrameSampler, InterpolatesLinearlyBetweenSteps) {
  Simulation simulation(test::homework(Method::liu13, 0.02, 180)), again(test::homework(Method::liu13, 0.02, 180));
  // A quarter of a step after every second one: frames at 0, 0.025, 0.05 s with h = 0.02 s.
  const auto frames = sampled(simulation, FilmExtent(video(40, 1), 0.02, 5, std::nullopt));
  ASSERT_EQ(frames.size(), 5u);
  again.step();
  const Vertices before = again.state().x;
  again.step();
  EXPECT_LT((frames[1].positions - (0.75 * before + 0.25 * again.state().x)).cwiseAbs().maxCoeff(), 1e-15);
  EXPECT_DOUBLE_EQ(frames[1].time, 0.025);
}

TEST(FrameSampler, TakesEveryStepWithItsOwnBits) {
  // The step is no binary fraction: rounding of k·h must not miss a step.
  Simulation simulation(test::homework(Method::liu13, 0.0123, 180)), again(test::homework(Method::liu13, 0.0123, 180));
  const auto frames = sampled(simulation, FilmExtent(video(25, 1), 0.0123, 20, std::nullopt, 3), FrameContents::motion);
  ASSERT_EQ(frames.size(), 7u);
  for (const Frame& frame : frames) {
    EXPECT_EQ(frame.time, again.time());
    EXPECT_EQ(frame.positions, again.state().x);
    EXPECT_EQ(frame.velocities, again.state().v);
    ASSERT_TRUE(frame.energies);
    EXPECT_EQ(frame.energies->total(), again.energies().total());
    for (int step = 0; step < 3; ++step) again.step();
  }
}

TEST(FrameSampler, InterpolatesHowTheClothMovesToo) {
  // In free fall velocities are linear in time, so interpolation is exact.
  SimulationSettings settings = test::setup(test::cloth_of(make_grid(2, 2), 1, 50, {}), Method::liu13, 0.02);
  settings.effects = {Gravity{}};
  const double g = Gravity{}.acceleration.z();
  Simulation simulation(settings);
  const auto frames = sampled(simulation, FilmExtent(video(37, 1), 0.02, 20, std::nullopt), FrameContents::motion);
  ASSERT_EQ(frames.size(), 15u);
  for (const Frame& frame : frames) {
    EXPECT_LT((frame.velocities.col(2).array() - g * frame.time).abs().maxCoeff(), 1e-12) << frame.time;
    ASSERT_TRUE(frame.energies);
    EXPECT_NEAR(frame.energies->elastic, 0, 1e-12);
  }
}

TEST(FrameSampler, AsksForNothingThatNobodyWants) {
  Simulation simulation(test::homework(Method::liu13, 0.02, 180));
  for (const Frame& frame : sampled(simulation, FilmExtent(video(25, 1), 0.02, 4, std::nullopt))) {
    EXPECT_EQ(frame.velocities.size(), 0);
    EXPECT_FALSE(frame.energies);
  }
}

// A rigidly moving scene gives the same picture at every time, also between two steps.
TEST(FrameSampler, ShowsClothAndSphereAtOneMoment) {
  const Eigen::Vector3d velocity(3, -1, 2), center(0, 0, -5);
  SimulationSettings settings = test::setup(test::cloth_of(make_grid(2, 2), 1, 50, {}), Method::liu13, 0.02);
  settings.cloth.velocities.rowwise() = velocity.transpose();
  settings.effects = {Sphere{.center = center, .radius = 0.5, .velocity = velocity}};
  Simulation simulation(settings);
  const auto frames = sampled(simulation, FilmExtent(video(37, 1), 0.02, 20, std::nullopt));
  ASSERT_EQ(frames.size(), 15u);
  for (const Frame& frame : frames) {
    const Eigen::Vector3d way = frame.time * velocity;
    EXPECT_LT(((frame.positions - settings.cloth.positions).rowwise() - way.transpose()).norm(), 1e-13) << frame.time;
    EXPECT_LT((std::get<SphereShape>(frame.colliders.at(0)).center - center - way).norm(), 1e-13) << frame.time;
  }
}

TEST(FrameSampler, GivesTheSameFramesWhereverItsRangeBegins) {
  Simulation whole(test::homework(Method::liu13, 0.02, 180)), part(test::homework(Method::liu13, 0.02, 180));
  const auto all = sampled(whole, FilmExtent(video(30, 1), 0.02, 30, std::nullopt));
  const auto some = sampled(part, FilmExtent(video(30, 1), 0.02, 30, FrameRange{5, 9}));
  ASSERT_EQ(some.size(), 5u);
  for (std::size_t i = 0; i < some.size(); ++i) {
    EXPECT_EQ(some[i].index, static_cast<int>(i) + 5);
    EXPECT_EQ(some[i].positions, all[i + 5].positions);
  }
}

}  // namespace
}  // namespace drape
