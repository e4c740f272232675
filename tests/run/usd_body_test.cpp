#include <gtest/gtest.h>

#include "scene/mesh_value.hpp"
#include "tests/support/written_motion.hpp"

namespace drape {
namespace {

TEST(UsdBody, IsAMeshThatMovesAsTheScenes) {
  const test::SceneFolder folder;
  const LoadedScene scene = folder.load(
      test::moving_scene + "[[effects.body]]\nbox = [0.5, 0.4, 0.1]\ncenter = [0, 0, -2]\nvelocity = [1, 0, 0]\n");
  const auto [result, frames] = test::write_motion(scene, {folder.path("x.usda")});
  const MeshMotion motion = read_mesh_motion(folder.path("x.usda"), {.prim = "/Scene/Body1"});
  EXPECT_EQ(motion.mesh.triangles.size(), 12U);
  ASSERT_EQ(motion.samples.size(), frames.size());
  for (const Frame& frame : frames) {
    Vertices x;
    motion.place(frame.time, x);
    EXPECT_NEAR(x(0, 0), -0.25 + frame.time, 1e-6);
  }
}

}  // namespace
}  // namespace drape
