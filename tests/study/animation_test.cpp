#include "study/animation.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "study/reference.hpp"
#include "tests/support/gif_file.hpp"
#include "tests/support/read_picture.hpp"
#include "tests/support/scene_folder.hpp"

namespace drape {
namespace {

TEST(Animation, HasAPanelForEachMotionAndAFrameForEachMoment) {
  const test::SceneFolder folder;
  const std::string file =
      folder
          .write("small.toml",
                 "[cloth]\nmesh = { grid = [3, 3] }\nstiffness = 20\npins = [0]\n[time]\nstep = 0.02\n"
                 "duration = 0.4\n[integrator]\nmethod = \"liu13\"\ntolerance = "
                 "1e-3\n[video]\nfps = 50\nsize = [340, 170]\n[effects.gravity]\n")
          .string();
  const Scene scene = load_scene(file);
  std::vector<AnimationPanel> panels;
  for (const char* tolerance : {"1e-1", "1e-2", "1e-3", "1e-4"}) {
    panels.push_back({{"", file, {std::string("integrator.tolerance=") + tolerance}, 20}, "tolerance"});
  }
  Progress progress;
  const auto gif_file = folder.path() / "a.gif";
  const auto animation = animate_errors(scene, to_rounding(scene.simulation, Method::implicit), panels, gif_file,
                                        GlBackend::automatic, {}, progress);
  ASSERT_TRUE(animation);
  EXPECT_EQ(animation->film.gif.size(), std::filesystem::file_size(gif_file));
  EXPECT_EQ(test::decoded_picture(animation->film.stills).cols,
            2 * (2 * 340 + 6) + 6);  // four of the five, in two rows
  const test::GifFile gif = test::read_gif(gif_file);
  EXPECT_EQ(gif.delays.size(), 5U);  // 0 to 0.4 s, 10 a second
  EXPECT_EQ(gif.width, 2 * 340 + 6);
  EXPECT_GT(gif.height, 2 * 170);
  EXPECT_EQ(animation->reference.frames, 5);
  EXPECT_EQ(animation->worst.frames, 5);
  EXPECT_NE(animation->worst.data, animation->reference.data);
  EXPECT_EQ(animation->worst_panel, 0U) << "the loosest tolerance ends furthest from the reference";
}

}  // namespace
}  // namespace drape
