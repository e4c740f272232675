#include "compare/compare_scenes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <opencv2/core.hpp>

#include "compare/panels.hpp"
#include "render/overlay/color_scale.hpp"
#include "run/run_scene.hpp"
#include "tests/support/files.hpp"
#include "tests/support/read_picture.hpp"
#include "tests/support/scene_folder.hpp"
#include "tests/support/usage_error.hpp"

namespace drape::compare_scenes_tests {
namespace {

const std::string film = test::swinging_cloth + "[video]\nsize = [120, 100]\n";
const std::string swinging = film + "[camera]\nposition = [3, -4, 3]\ntarget = [0, 0, -0.5]\n";

CompareResult compare(const std::vector<LoadedScene>& scenes, const CompareOptions& options) {
  require_comparison(scenes, options);
  Progress progress;
  return compare_scenes(scenes, options, {}, progress);
}

/// Returns true if a picture appears somewhere within another.
bool contains(const cv::Mat& whole, const cv::Mat& part) {
  for (int y = 0; y + part.rows <= whole.rows; ++y) {
    for (int x = 0; x + part.cols <= whole.cols; x += 6) {
      const cv::Mat here = whole(cv::Rect(x, y, part.cols, part.rows));
      if (cv::norm(here.row(part.rows / 2), part.row(part.rows / 2), cv::NORM_INF) == 0 &&
          cv::norm(here, part, cv::NORM_INF) == 0)
        return true;
    }
  }
  return false;
}

TEST(CompareScenes, ShowsEachMotionAsItsOwnFilmWould) {
  const test::SceneFolder folder;
  const std::vector<LoadedScene> scenes{folder.load(swinging), folder.load(swinging, {"cloth.stiffness=5"})};
  CompareOptions options;
  options.outputs = {folder.path("both.png")};
  const CompareResult result = compare(scenes, options);
  EXPECT_EQ(result.times.size(), 6U);
  const cv::Mat both = test::read_picture(options.outputs[0]);
  for (const LoadedScene& scene : scenes) {
    RunOptions run;
    run.outputs = {folder.path("one.png")};
    Progress progress;
    run_scene(scene, run, {}, progress);
    EXPECT_TRUE(contains(both, test::read_picture(run.outputs[0])));
  }
  EXPECT_EQ(both.cols, comparison_info(scenes, options).width);
  EXPECT_EQ(both.rows, comparison_info(scenes, options).height);
}

/// The camera chooses its direction, follows and orbits.
TEST(CompareScenes, TheCameraMovesAsInTheFirstOnesFilm) {
  const test::SceneFolder folder;
  const LoadedScene scene = folder.load(film + "[camera]\nfollow = true\norbit = 90\n");
  CompareOptions options;
  options.outputs = {folder.path("both{frame}.png")};
  compare({scene, scene}, options);
  RunOptions run;
  run.outputs = {folder.path("one{frame}.png")};
  Progress progress;
  run_scene(scene, run, {}, progress);
  for (const char* frame : {"0", "3", "5"}) {
    const std::string name = std::string(frame) + ".png";
    EXPECT_TRUE(contains(test::read_picture(folder.path("both" + name)), test::read_picture(folder.path("one" + name))))
        << frame;
  }
}

/// Records a scene's motion.
std::shared_ptr<MotionReader> recorded(const LoadedScene& scene, const std::string& file) {
  RunOptions run;
  run.motion.emplace();
  run.motion->path = file;
  Progress progress;
  run_scene(scene, run, {}, progress);
  return std::make_shared<MotionReader>(file);
}

TEST(CompareScenes, DrawsMotionsFromFilesAsTheirScenes) {
  const test::SceneFolder folder;
  const std::vector<LoadedScene> scenes{folder.load(film + "[look]\ncolor_by = \"speed\"\n"),
                                        folder.load(film, {"cloth.stiffness=5", "time.duration=0.1"})};
  CompareOptions options;
  options.outputs = {folder.path("simulated.gif")};
  const CompareResult simulated = compare(scenes, options);
  const auto first = recorded(scenes[0], folder.path("0.drape")), second = recorded(scenes[1], folder.path("1.drape"));
  const std::vector<std::vector<std::shared_ptr<MotionReader>>> some_recorded{
      {first, second}, {first, nullptr}, {nullptr, second}};
  for (const auto& motions : some_recorded) {
    options.recorded = motions;
    options.outputs = {folder.path("recorded.gif")};
    const CompareResult read = compare(scenes, options);
    EXPECT_TRUE(test::content(options.outputs[0]) == test::content(folder.path("simulated.gif")));
    for (std::size_t i = 0; i < scenes.size(); ++i) {
      EXPECT_EQ(read.motions[i].total_energy, simulated.motions[i].total_energy);
      EXPECT_EQ(read.motions[i].statistics.steps(), simulated.motions[i].statistics.steps());
      EXPECT_EQ(read.motions[i].statistics.mean_iterations(), simulated.motions[i].statistics.mean_iterations());
    }
  }
}

TEST(CompareScenes, OneCameraHasAllOfThemInView) {
  const test::SceneFolder folder;
  const std::vector<LoadedScene> scenes{
      folder.load(film, {"look.background=white"}),
      folder.load(film, {"look.background=white", "cloth.transform.translate=[4, 0, 0]"})};
  CompareOptions options;
  options.outputs = {folder.path("both.png")};
  options.columns = 1;
  compare(scenes, options);
  const cv::Mat both = test::read_picture(options.outputs[0]);
  // Neither film touches the sides of its panel, and the cloths are at different places.
  for (int y = 0; y < both.rows; ++y) {
    EXPECT_EQ(both.at<cv::Vec3b>(y, 0), cv::Vec3b(255, 255, 255));
    EXPECT_EQ(both.at<cv::Vec3b>(y, both.cols - 1), cv::Vec3b(255, 255, 255));
  }
}

TEST(CompareScenes, AMotionThatIsOverStaysAsItWas) {
  const test::SceneFolder folder;
  const std::vector<LoadedScene> scenes{folder.load(swinging), folder.load(swinging, {"time.duration=0.04"})};
  CompareOptions options;
  const CompareResult result = compare(scenes, options);
  EXPECT_EQ(result.times.size(), 6U);
  EXPECT_EQ(result.motions[1].total_energy[1], result.motions[1].total_energy[5]);
  EXPECT_NE(result.motions[0].total_energy[1], result.motions[0].total_energy[5]);
  EXPECT_EQ(result.motions[0].statistics.steps(), 10);
  EXPECT_EQ(result.motions[1].statistics.steps(), 2);
}

TEST(CompareScenes, TheSameMotionHasNoDistanceAndTheFirstColour) {
  const test::SceneFolder folder;
  const std::vector<LoadedScene> scenes{folder.load(swinging), folder.load(swinging, {"look.line_width=2"}),
                                        folder.load(swinging, {"cloth.stiffness=5"})};
  CompareOptions options;
  options.difference = true;
  const CompareResult result = compare(scenes, options);
  EXPECT_EQ(*std::max_element(result.motions[1].most.begin(), result.motions[1].most.end()), 0);
  EXPECT_GT(result.motions[2].most.back(), 0.01);
  EXPECT_LE(result.motions[2].mean.back(), result.motions[2].most.back());
}

/// Returns frames of the first scene, in which it rests, and of others, moved by distances from 0 to `most`.
std::vector<Frame> moved_by(const Scene& scene, const std::vector<double>& most) {
  std::vector<Frame> frames(most.size());
  for (std::size_t i = 0; i < most.size(); ++i) {
    frames[i].positions = scene.simulation.cloth.positions;
    const Eigen::Index count = frames[i].positions.rows();
    for (Eigen::Index v = 0; v < count; ++v) {
      frames[i].positions(v, 0) += most[i] * static_cast<double>(v) / static_cast<double>(count - 1);
    }
  }
  return frames;
}

std::vector<const Frame*> pointers(const std::vector<Frame>& frames) {
  std::vector<const Frame*> list;
  for (const Frame& frame : frames) list.push_back(&frame);
  return list;
}

TEST(CompareScenes, ColoursDistancesOverThreeDecadesBelowTheLimit) {
  const test::SceneFolder folder;
  const std::vector<LoadedScene> scenes{folder.load(swinging), folder.load(swinging)};
  const PanelColors colors(scenes, {"a", "b"}, true, 0.02);
  EXPECT_FALSE(colors.needs_motion()) << "a given limit needs no survey";
  const auto frames = moved_by(scenes[0], {0, 0.02});
  const std::vector<Rgb> shown = colors.colors(pointers(frames), 1);
  for (std::size_t v = 0; v < shown.size(); ++v) {
    const double part = static_cast<double>(v) / static_cast<double>(shown.size() - 1);
    const Rgb expected = viridis(part == 0 ? 0 : 1 + std::log10(part) / 3);
    EXPECT_NEAR(shown[v].r, expected.r, 1e-9) << v;
    EXPECT_NEAR(shown[v].g, expected.g, 1e-9) << v;
    EXPECT_NEAR(shown[v].b, expected.b, 1e-9) << v;
  }
  const auto further = moved_by(scenes[0], {0, 20});
  EXPECT_EQ(colors.colors(pointers(further), 1).back(), viridis(1)) << "beyond the limit";
  EXPECT_TRUE(colors.colors(pointers(frames), 0).empty()) << "the first keeps its look";
}

// Two motions that part exponentially, one a hundred times as far as the other, both show where they differ.
TEST(CompareScenes, FindsALimitThatShowsAllMotions) {
  const test::SceneFolder folder;
  const std::vector<LoadedScene> scenes(3, folder.load(swinging));
  PanelColors colors(scenes, {"a", "b", "c"}, true, std::nullopt);
  EXPECT_TRUE(colors.needs_motion());
  std::vector<std::vector<Frame>> film;
  for (int k = 0; k <= 20; ++k) {
    const double most = 0.1 * std::pow(10, (k - 20) / 10.0);
    film.push_back(moved_by(scenes[0], {0, most, most / 100}));
    colors.survey(pointers(film.back()));
  }
  const auto brightness = [&](const std::vector<Frame>& frames, std::size_t panel) {
    const std::vector<Rgb> shown = colors.colors(pointers(frames), panel);
    return std::pair(shown.front().g, shown.back().g);  // viridis gains green throughout
  };
  for (const std::size_t panel : {1U, 2U}) {
    const auto [least, most] = brightness(film.back(), panel);
    EXPECT_GT(most - least, 0.2) << panel;
  }
  const auto [least, most] = brightness(film.front(), 1);
  EXPECT_GT(most - least, 0.2) << "early in the motion, too";
}

TEST(CompareScenes, RefusesWhatCannotBeCompared) {
  const test::SceneFolder folder;
  const std::vector<LoadedScene> scenes{folder.load(swinging), folder.load(swinging, {"cloth.mesh={ grid = [4, 4] }"})};
  CompareOptions options;
  options.difference = true;
  EXPECT_NE(test::usage_error([&] { require_comparison(scenes, options); }).find("has 49 vertices and "),
            std::string::npos);
  options.difference = false;
  options.columns = options.rows = 1;
  EXPECT_EQ(test::usage_error([&] { require_comparison(scenes, options); }),
            "--grid 1x1 has 1 places, but 2 motions are compared");
  options.columns = options.rows = 0;
  options.outputs = {folder.path("a.obj")};
  EXPECT_NE(test::usage_error([&] { require_comparison(scenes, options); }).find("draws pictures"), std::string::npos);
}

TEST(CompareScenes, ASheetHasTheColourBarOnce) {
  const test::SceneFolder folder;
  const std::vector<LoadedScene> scenes{folder.load(swinging), folder.load(swinging, {"cloth.stiffness=5"})};
  CompareOptions options;
  options.difference = true;
  options.outputs = {folder.path("one.png")};
  compare(scenes, options);
  const int whole = test::read_picture(options.outputs[0]).rows;
  options.sheet = SheetGrid{1, 3};
  compare(scenes, options);
  Pen pen;
  const int bar = comparison_info(scenes, options).bands;
  EXPECT_EQ(bar, PanelColors(scenes, {"a", "b"}, true, 1).bar(pen, 300, 11).height);
  EXPECT_EQ(test::read_picture(options.outputs[0]).rows, 3 * (whole - bar) + 2 * 6 + bar);
}

TEST(CompareScenes, HasTheDistanceInsideANarrowPanel) {
  Pen pen;
  for (const int width : {100, 128, 160}) {
    const PanelLayout layout(pen, {"a", "b"}, {width, 100}, 2, 1, 1, false);
    const Image whole = layout.compose(pen, std::vector<Image>(2, Image(width, 100)),
                                       {"", "at most 1.34 m from the first"}, "t = 0.00 s", std::nullopt);
    for (int y = 0; y < 2 * Pen::line_height(11); ++y) {
      EXPECT_GT(*whole.at(whole.width - 1, y), 160) << width << ' ' << y;
      EXPECT_GT(*whole.at(whole.width - 2, y), 160) << width << ' ' << y;
    }
  }
}

TEST(CompareScenes, GivesTheSameBytesTwice) {
  const test::SceneFolder folder;
  const std::vector<LoadedScene> scenes{folder.load(swinging), folder.load(swinging, {"cloth.stiffness=5"})};
  CompareOptions options;
  options.difference = true;
  for (const char* name : {"1.gif", "2.gif"}) {
    options.outputs = {folder.path(name)};
    compare(scenes, options);
  }
  EXPECT_EQ(test::content(folder.path("1.gif")), test::content(folder.path("2.gif")));
}

TEST(CompareScenes, MakesAPageThatHoldsItsPictures) {
  const test::SceneFolder folder;
  const std::vector<LoadedScene> scenes{folder.load(swinging), folder.load(swinging, {"cloth.stiffness=5"})};
  CompareOptions options;
  options.outputs = {folder.path("page.html")};
  options.command = "drape compare a b";
  compare(scenes, options);
  const std::string page = test::content(options.outputs[0]);
  std::size_t pictures = 0;
  for (std::size_t at = 0; (at = page.find("data:image/png", at)) != std::string::npos; ++at) ++pictures;
  EXPECT_EQ(pictures, 12U);  // 6 frames of 2 motions
  EXPECT_NE(page.find("cloth.stiffness"), std::string::npos);
}

TEST(CompareScenes, TellsMomentsApartThatAreMillisecondsApart) {
  const test::SceneFolder folder;
  const std::vector<std::string> slow{"time.duration=0.02", "time.step=0.002", "video.speed=0.05"};
  const std::vector<LoadedScene> scenes{folder.load(swinging, slow), folder.load(swinging, slow)};
  CompareOptions options;
  options.outputs = {folder.path("page.html"), folder.path("{frame}.png")};
  compare(scenes, options);
  const std::string page = test::content(options.outputs[0]);
  for (const char* time : {"t = 0.002 s", "t = 0.004 s", "0.002 s: ", "0.004 s: "}) {
    EXPECT_NE(page.find(time), std::string::npos) << time;
  }
  const auto foot = [&](const char* file) -> cv::Mat {
    const cv::Mat whole = test::read_picture(folder.path(file));
    return whole.rowRange(whole.rows - 12, whole.rows);
  };
  EXPECT_GT(cv::norm(foot("01.png"), foot("02.png"), cv::NORM_INF), 0);
}

}  // namespace
}  // namespace drape::compare_scenes_tests
