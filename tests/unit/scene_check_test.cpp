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
