#include "run/outputs.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <opencv2/core.hpp>

#include "render/overlay/color_scale.hpp"
#include "run/run_scene.hpp"
#include "tests/support/files.hpp"
#include "tests/support/read_picture.hpp"
#include "tests/support/scene_folder.hpp"

namespace drape::annotations {
namespace {

const std::string swinging = test::swinging_cloth + "[video]\nsize = [200, 160]\n";

/// Returns the last picture of a scene's film.
cv::Mat last_picture(const std::string& more) {
  const test::SceneFolder folder;
  RunOptions options;
  options.outputs = {(folder.path() / "still.png").string()};
  Progress progress;
  run_scene(folder.load(swinging + more), options, {}, progress);
  return test::read_picture(options.outputs[0]);
}

bool same(const cv::Mat& a, const cv::Mat& b) { return a.size() == b.size() && cv::norm(a, b, cv::NORM_INF) == 0; }

TEST(Annotations, LeaveThePictureAsItIsWhereTheyAreNot) {
  const cv::Mat plain = last_picture("");
  ASSERT_EQ(plain.size(), cv::Size(200, 160));
  const cv::Mat captioned = last_picture("[caption]\ntext = \"t = {time:.2f} s\"\nplace = \"bottom\"\nsize = 14\n");
  EXPECT_FALSE(same(plain, captioned));
  EXPECT_TRUE(same(plain.rowRange(0, 120), captioned.rowRange(0, 120)));
}

TEST(Annotations, ACaptionThatDoesNotFitIsRefusedBeforeTheRun) {
  const test::SceneFolder folder;
  const auto refusal = [&](const std::string& caption) {
    const LoadedScene scene = folder.load(test::swinging_cloth + "[video]\nsize = [64, 64]\n[caption]\n" + caption);
    return folder.without_folder(test::usage_error([&] { Annotations{scene}; }));
  };
  EXPECT_TRUE(refusal("text = \"t = {time:.2f} s\"\nsize = 512\n")
                  .starts_with("scene.toml:12:8: a caption of size = 512 does not fit into a picture of 64x64 pixels: "
                               "the largest that fits is size = "));
  EXPECT_EQ(refusal("text = \"t = {time:.2f} s\"\n"), "(no error)");
  // It fits at the film's beginning, but not at its end.
  EXPECT_NE(refusal("text = \"{time:.0f}{time:.50f}\"\nsize = 30\n"), "(no error)");
}

TEST(Annotations, BandsMakeTheFilmHigherAndLeaveThePicture) {
  const cv::Mat plain = last_picture(""), with = last_picture("[overlay]\nenergies = true\n");
  EXPECT_EQ(with.cols, 200);
  ASSERT_GT(with.rows, 160);
  EXPECT_TRUE(same(plain, with.rowRange(0, 160)));
  const test::SceneFolder folder;
  EXPECT_EQ(Annotations::film_size(folder.load(swinging + "[overlay]\nenergies = true\n")).y(), with.rows);
}

TEST(Annotations, AreTheSameForPartOfAFilm) {
  const test::SceneFolder folder;
  const LoadedScene scene = folder.load(swinging + "[overlay]\nenergies = true\n[look]\ncolor_by = \"speed\"\n");
  Progress progress;
  RunOptions options;
  options.outputs = {(folder.path() / "{frame:04}.png").string()};
  run_scene(scene, options, {}, progress);
  const std::string whole = test::content(folder.path() / "0003.png");
  ASSERT_FALSE(whole.empty());
  options.frames = FrameRange{3, 3};
  options.outputs = {(folder.path() / "part-{frame:04}.png").string()};
  run_scene(scene, options, {}, progress);
  EXPECT_EQ(test::content(folder.path() / "part-0003.png"), whole);
}

TEST(Annotations, ASceneWithoutThemHasNone) {
  const test::SceneFolder folder;
  EXPECT_FALSE(Annotations::wanted(folder.load(swinging)));
  EXPECT_EQ(Annotations::film_size(folder.load(swinging)), Eigen::Vector2i(200, 160));
}

TEST(VertexColoring, OfAStretchedGridIsTheMapsColourOfItsStretch) {
  const Mesh grid = make_grid(6, 5);
  const Cloth cloth = make_cloth(grid, grid, 1, 10, {});
  const VertexColoring coloring(ColorBy::stretch, 0.2, cloth);
  for (const double stretch : {1.0, 1.05, 1.1, 1.2, 1.5}) {
    Frame frame;
    frame.positions = cloth.rest;
    frame.positions.col(0) *= stretch;  // λ₁ = stretch and λ₂ = 1, everywhere
    const Rgb expected = viridis((stretch - 1) / 0.2);
    for (const Rgb& color : coloring.colors(frame)) {
      EXPECT_NEAR(color.r, expected.r, 1e-9);
      EXPECT_NEAR(color.g, expected.g, 1e-9);
      EXPECT_NEAR(color.b, expected.b, 1e-9);
    }
  }
}

TEST(VertexColoring, TakesItsLimitFromTheMotion) {
  const Mesh grid = make_grid(9, 9);
  const Cloth cloth = make_cloth(grid, grid, 1, 10, {});
  VertexColoring coloring(ColorBy::speed, std::nullopt, cloth);
  EXPECT_TRUE(coloring.scale().needs_motion());
  Frame frame;
  frame.positions = cloth.rest;
  for (const double speed : {0.5, 3.0, 1.0}) {
    frame.velocities = Vertices::Zero(100, 3);
    frame.velocities.col(2).setConstant(speed);
    frame.velocities(7, 2) = 40;  // one vertex in a hundred does not count
    coloring.survey(frame);
  }
  EXPECT_EQ(coloring.scale().limit(), 5);
  EXPECT_EQ(coloring.measure().title(), "speed [m/s]");
  EXPECT_EQ(coloring.marks().back().label, "≥ 5");
}

}  // namespace
}  // namespace drape::annotations
