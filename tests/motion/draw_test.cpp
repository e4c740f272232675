#include <gtest/gtest.h>

#include "run/frame_source.hpp"
#include "run/outputs.hpp"
#include "run/run_scene.hpp"
#include "tests/motion/recorded.hpp"
#include "tests/support/files.hpp"
#include "tests/support/setups.hpp"

namespace drape::test {
namespace {

std::vector<Frame> simulated(const Scene& scene, const FilmExtent& extent) {
  std::vector<Frame> frames;
  FrameSampler sampler(
      extent, [&](Frame frame) { frames.push_back(std::move(frame)); }, FrameContents::motion);
  Simulation simulation(scene.simulation);
  run_steps(simulation, extent.steps, std::array<StepObserver*, 1>{&sampler}, {});
  return frames;
}

std::vector<Frame> recorded(const std::string& file, const Scene& scene, const FilmExtent& extent) {
  std::vector<Frame> frames;
  MotionReader motion(file);
  sample_motion(motion, scene, extent, FrameContents::motion, [&](Frame frame) { frames.push_back(std::move(frame)); },
                {});
  return frames;
}

void expect_same(const std::vector<Frame>& frames, const std::vector<Frame>& expected) {
  ASSERT_EQ(frames.size(), expected.size());
  for (std::size_t k = 0; k < frames.size(); ++k) {
    EXPECT_EQ(frames[k].index, expected[k].index);
    EXPECT_EQ(frames[k].time, expected[k].time);
    EXPECT_TRUE(same_bits(frames[k].positions, expected[k].positions)) << k;
    EXPECT_TRUE(same_bits(frames[k].velocities, expected[k].velocities)) << k;
    EXPECT_EQ(frames[k].energies->elastic, expected[k].energies->elastic);
    EXPECT_EQ(std::get<SphereShape>(frames[k].colliders[0]).center,
              std::get<SphereShape>(expected[k].colliders[0]).center);
  }
}

/// Stops before the camera's position is known.
TEST(RecordedFrames, AreNotDrawnWhereThatIsInterrupted) {
  const SceneFolder folder;
  const LoadedScene scene = folder.load(recorded_scene);
  record(scene, folder.path("m.drape"));
  for (const std::string camera : {"", "[camera]\nfollow = true\n"}) {
    RunOptions options;
    options.recorded = std::make_shared<MotionReader>(folder.path("m.drape"));
    options.outputs = {folder.path("m.gif")};
    std::stop_source stop;
    stop.request_stop();
    Progress progress;
    const RunResult result = run_scene(folder.load(recorded_scene + camera), options, stop.get_token(), progress);
    EXPECT_EQ(result.outcome, Outcome::interrupted);
    EXPECT_FALSE(std::filesystem::exists(folder.path("m.gif")));
  }
}

/// A motion's own texture is in a temporary folder while the motion is open.
TEST(RecordedFrames, HaveACopyOfTheTextureBesideAUsdFile) {
  const SceneFolder folder;
  const std::string picture = content(std::filesystem::path(DRAPE_SOURCE_DIR) / "textures/plaid.png");
  folder.write("mine.png", picture);
  record(folder.load(recorded_scene + "[look]\ntexture = \"mine.png\"\n"), folder.path("m.drape"));
  const auto write = [&] {
    RunOptions options;
    options.recorded = std::make_shared<MotionReader>(folder.path("m.drape"));
    options.outputs = {"x.usda"};
    const MotionScene opened(*options.recorded);
    Progress progress;
    run_scene(opened.scene(), options, {}, progress);
    return content(folder.path("x.usda"));
  };
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(folder.path());
  const std::string text = write();
  EXPECT_NE(text.find("inputs:file = @./x.texture.png@"), std::string::npos);
  EXPECT_TRUE(content(folder.path("x.texture.png")) == picture);
  EXPECT_TRUE(write() == text);
  folder.write("x.texture.png", "mine");
  EXPECT_NE(usage_error([&] { write(); }).find("x.texture.png exists and is not the motion's texture"),
            std::string::npos);
  EXPECT_EQ(content(folder.path("x.texture.png")), "mine");
  std::filesystem::current_path(before);
}

TEST(RecordedFrames, AreThoseOfTheSimulation) {
  const SceneFolder folder;
  const LoadedScene scene = folder.load(recorded_scene);
  record(scene, folder.path("m.drape"));
  for (const double fps : {20.0, 50.0, 7.3, 200.0}) {
    for (const std::optional<FrameRange> range : {std::optional<FrameRange>(), std::optional(FrameRange{3, 5})}) {
      Video video = scene.video;
      video.fps = fps;
      const FilmExtent extent(video, scene.simulation.step, scene.step_count(), range);
      expect_same(recorded(folder.path("m.drape"), scene, extent), simulated(scene, extent));
    }
  }
  const FilmExtent steps(scene.video, scene.simulation.step, scene.step_count(), {}, 7);
  expect_same(recorded(folder.path("m.drape"), scene, steps), simulated(scene, steps));
}

TEST(RecordedFrames, AreThoseOfTheSimulationWhereOnlyWhatTheyNeedIsRecorded) {
  for (const std::string fps : {"20", "50", "7.3", "200"}) {
    const SceneFolder folder;
    const LoadedScene scene = folder.load(recorded_scene, {"video.fps=" + fps});
    RunOptions options;
    options.motion = MotionOptions{.recorded = {.every = std::nullopt}};
    record(scene, folder.path("m.drape"), options);
    const FilmExtent extent = film_extent(scene, {});
    expect_same(recorded(folder.path("m.drape"), scene, extent), simulated(scene, extent));
    EXPECT_EQ(frames_in_gaps(MotionReader(folder.path("m.drape")), extent), 0);
  }
}

TEST(RecordedFrames, AreCountedWhereTheyAreMissing) {
  const SceneFolder folder;
  const LoadedScene scene = folder.load(recorded_scene);
  RunOptions options;
  options.motion = MotionOptions{.recorded = {.every = 5}};
  record(scene, folder.path("m.drape"), options);
  // Frame k is at step 2.5 k: odd ones fall between recorded states.
  EXPECT_EQ(frames_in_gaps(MotionReader(folder.path("m.drape")), film_extent(scene, {})), 10);
  EXPECT_EQ(recorded(folder.path("m.drape"), scene, film_extent(scene, {})).size(), 21u);
}

/// Pictures of a motion file, whose camera is found without another simulation.
TEST(RecordedFrames, AreDrawnAsTheSimulationsAre) {
  const SceneFolder folder;
  const LoadedScene scene = folder.load(recorded_scene);
  record(scene, folder.path("m.drape"));
  RunOptions options;
  options.outputs = {folder.path("direct.gif"), folder.path("direct.npz")};
  Progress progress;
  run_scene(scene, options, {}, progress);
  options.outputs = {folder.path("later.gif"), folder.path("later.npz")};
  options.recorded = std::make_shared<MotionReader>(folder.path("m.drape"));
  const RunResult result = run_scene(scene, options, {}, progress);
  EXPECT_TRUE(result.recorded);
  EXPECT_EQ(result.outcome, Outcome::completed);
  EXPECT_EQ(result.frames, 21);
  EXPECT_EQ(result.statistics.steps(), 0);
  EXPECT_TRUE(content(folder.path("later.gif")) == content(folder.path("direct.gif")));
  EXPECT_TRUE(content(folder.path("later.npz")) == content(folder.path("direct.npz")));
}

TEST(MotionSpace, IsNoLessThanWhatAFileTakes) {
  const SceneFolder folder;
  const LoadedScene scene = folder.load(recorded_scene, {"cloth.mesh={grid=[20,20]}", "time.duration=3"});
  for (const std::optional<std::int64_t> every :
       {std::optional<std::int64_t>(1), std::optional<std::int64_t>(10), std::optional<std::int64_t>()}) {
    RunOptions options;
    options.motion = MotionOptions{.path = folder.path("m.drape"), .recorded = {every}};
    const MotionSpace space = motion_space(scene, options);
    record(scene, folder.path("m.drape"), options);
    const auto size = static_cast<double>(std::filesystem::file_size(folder.path("m.drape")));
    EXPECT_LE(size, space.most);
    EXPECT_LE(size, 1.2 * space.expected);
    EXPECT_GE(size, 0.3 * space.expected);
    EXPECT_GT(space.free, 0);
  }
}

TEST(MotionSpace, IsAskedForBeforeARun) {
  const SceneFolder folder;
  const MotionOptions options{.path = folder.path("m.drape")};
  EXPECT_NO_THROW(require_motion_file(options, {.expected = 4e9, .most = 9e9, .free = 5e9}, false));
  const std::string message = folder.without_folder(
      usage_error([&] { require_motion_file(options, {.expected = 6e9, .most = 9e9, .free = 5e6}, false); }));
  EXPECT_EQ(message,
            "m.drape will take about 6 GB (at most 9 GB), and 5 MB are free there: free some space, or store fewer "
            "states with --every frames or --every N, or use a shorter [time] duration");
}

}  // namespace
}  // namespace drape::test
