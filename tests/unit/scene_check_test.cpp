#include <gtest/gtest.h>

#include "tests/support/scene_folder.hpp"

// The table [check] of a scene.

namespace drape::scene_check {
namespace {

using test::least_scene;

TEST(SceneCheck, TakesPartsOfPicturesThatAreNotJudged) {
  const test::SceneFolder folder;
  const Scene scene =
      folder.load(least_scene + "[check]\nignore = [[0, 0, 60, 20], [5, 6, 7, 8]]\nignore_frames = [3]\n");
  EXPECT_EQ(scene.check.ignore, (std::vector<PixelRectangle>{{0, 0, 60, 20}, {5, 6, 7, 8}}));
  EXPECT_EQ(scene.check.ignore_frames, std::vector<int>{3});
  const std::string check = least_scene + "[check]\nignore = ";
  EXPECT_EQ(folder.problems(check + "[[0, 0, 60]]\n"),
            "scene.toml:7:11: ignore: expected [x, y, width, height], with a width and a height above 0");
  EXPECT_EQ(folder.problems(check + "[[0, 0, 60, 0]]\n"),
            "scene.toml:7:11: ignore: expected [x, y, width, height], with a width and a height above 0");
  EXPECT_EQ(folder.problems(check + "true\n"),
            "scene.toml:7:10: ignore: expected [[x, y, width, height], …], found true or false");
  EXPECT_NE(folder.problems(check + "[[0, 0, -1, 5]]\n").find("scene.toml:7:18: ignore"), std::string::npos);
}

TEST(SceneCheck, TakesALimitOfTime) {
  const test::SceneFolder folder;
  EXPECT_FALSE(folder.load(least_scene).check.time);
  EXPECT_EQ(folder.load(least_scene + "[check]\ntime = 1.3\n").check.time, 1.3);
  EXPECT_NE(folder.problems(least_scene + "[check]\ntime = 1\n").find("time"), std::string::npos);
}

TEST(SceneCheck, RefusesToIgnoreWhatThereIsNot) {
  const test::SceneFolder folder;
  const std::string check =
      "[cloth]\nmesh = { grid = [2, 2] }\nstiffness = 7\n[time]\nstep = 0.02\nduration = 0.2\n[check]\nsize = [64, "
      "48]\n";
  EXPECT_EQ(folder.problems(check + "ignore = [[0, 0, 9, 9], [0, 48, 9, 9]]\n"),
            "scene.toml:9:10: ignore: [0, 48, 9, 9] is outside of the picture, which has 64x48 pixels");
  EXPECT_EQ(folder.problems(check + "ignore = [[63, 47, 99, 99]]\n"), "(no error)");
  EXPECT_EQ(folder.problems(check + "ignore_frames = [0, 99999]\n"),
            "scene.toml:9:17: ignore_frames: the film ends with frame 5, found 99999");
  // Entries for parts that an override has removed are accepted.
  EXPECT_EQ(folder.problems(check + "ignore_frames = [5]\n", {"time.duration=0.1"}), "(no error)");
  EXPECT_EQ(folder.problems(check + "ignore = [[60, 0, 4, 4]]\n", {"check.size=[32, 24]"}), "(no error)");
}

TEST(SceneCheck, SaysWhatIsThereInsteadOfAWindowOfSteps) {
  const test::SceneFolder folder;
  EXPECT_EQ(folder.problems(least_scene + "[check]\nwindow = 20\n"),
            "scene.toml:7:1: 'window' in [check] no longer exists: the whole motion is compared now, in windows of "
            "'window_time' seconds");
  EXPECT_EQ(folder.load(least_scene + "[check]\nwindow_time = 1.5\n").check.window_time, 1.5);
  EXPECT_NE(folder.problems(least_scene + "[check]\nwindow_time = 0\n"), "(no error)");
}

}  // namespace
}  // namespace drape::scene_check
