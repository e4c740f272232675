// Numbers whose products overflow are refused as positions or velocities.

#include <gtest/gtest.h>

#include "tests/support/scene_folder.hpp"

namespace drape::scene_reach {
namespace {

using test::SceneFolder;

const std::string sphere = "center = [0, 0, 0]\nradius = 1\n";

std::string problems(const std::string& tables) {
  const SceneFolder folder;
  return folder.problems(test::least_scene + tables);
}

TEST(SceneReach, EndsBeforeProductsOverflow) {
  const std::string keyframes =
      "keyframes = [{ time = 0, center = [0, 0, 0] }, { time = 1, center = [1e154, 0, 0] }]\n";
  const std::vector<std::string> far{
      "[effects.sphere]\ncenter = [1e154, 0, 0]\nradius = 1\n",
      "[effects.sphere]\ncenter = [0, 0, 0]\nradius = 1e154\n",
      "[effects.sphere]\n" + sphere + "velocity = [0, -1e154, 0]\n",
      "[effects.sphere]\n" + sphere + "orbit_period = 1\norbit_center = [0, 0, 1e154]\n",
      "[effects.sphere]\nradius = 1\n" + keyframes,
      "[effects.body]\nbox = [1, 1, 1e154]\nthickness = 0.1\n",
      "[effects.body]\nbox = [1, 1, 1]\ncenter = [1e154, 0, 0]\nthickness = 0.1\n",
      "[effects.ground]\nheight = -1e154\n",
      "[camera]\nposition = [1e155, 0, 0]\n",
      "[camera]\ntarget = [0, 1e155, 0]\n",
  };
  for (const std::string& table : far) {
    const std::string text = problems(table);
    EXPECT_NE(text.find("; beyond 1e+90 m"), std::string::npos) << table << text;
    EXPECT_NE(text.find("it overflows double precision"), std::string::npos) << table << text;
  }
  EXPECT_EQ(problems("[effects.sphere]\ncenter = [1e90, 0, 0]\nradius = 1\n[camera]\nposition = [0, -1e90, 0]\n"),
            "(no error)");
  EXPECT_EQ(problems("[effects.gravity]\nacceleration = [0, 0, -1e154]\n"), "(no error)");
}

TEST(SceneReach, IsThatOfBodiesOfFiles) {
  const SceneFolder folder;
  folder.write("far.obj", "v 0 0 0\nv 1e154 0 0\nv 0 1 0\nf 1 2 3\n");
  EXPECT_NE(folder.problems(test::least_scene + "[effects.body]\nfile = \"far.obj\"\nthickness = 0.1\n")
                .find("file: a vertex is at 1e+154 m; distances beyond 1e+90 m overflow double precision"),
            std::string::npos);
}

}  // namespace
}  // namespace drape::scene_reach
