// Bodies in scenes, and warnings about a cloth that starts inside of an obstacle.

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "drape/sim/effects/body.hpp"
#include "drape/sim/effects/sphere.hpp"
#include "drape/sim/simulation.hpp"
#include "sim/start_overlap.hpp"
#include "tests/support/scene_folder.hpp"

namespace drape {
namespace {

using Eigen::RowVector3d;
using Eigen::Vector3d;
using test::least_scene;
using test::SceneFolder;

/// A body that may begin across the cloth.
std::string with_body(const std::string& lines) {
  return least_scene + "[[effects.body]]\n" + lines + "\nallow_overlap = true\n";
}

MeshShape shape_at(const Scene& scene, double time) {
  return std::get<MeshShape>(Simulation(scene.simulation).colliders(time).at(0));
}

TEST(SceneBodies, AreBoxesOrMeshesOfAFile) {
  const SceneFolder folder;
  const MeshShape box = shape_at(folder.load(with_body("box = [2, 4, 6]\ncenter = [0, 0, 5]")), 0);
  EXPECT_EQ(box.triangles->size(), 12U);
  EXPECT_EQ(RowVector3d(box.positions.colwise().minCoeff()), RowVector3d(-1, -2, 2));
  EXPECT_EQ(RowVector3d(box.positions.colwise().maxCoeff()), RowVector3d(1, 2, 8));
  folder.write("roof.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 2 4\n");
  const MeshShape roof = shape_at(folder.load(with_body("file = \"roof.obj\"\ncenter = [7, 0, 0]")), 0);
  EXPECT_EQ(roof.triangles->size(), 2U);
  EXPECT_EQ(RowVector3d(roof.positions.row(1)), RowVector3d(8, 0, 0));
}

TEST(SceneBodies, MoveStraightOnKeyframesOrTurnWithTheirOrbit) {
  const SceneFolder folder;
  const auto corner = [&](const std::string& lines, double time) {
    return RowVector3d(shape_at(folder.load(with_body("box = [2, 2, 2]\n" + lines)), time).positions.row(7));
  };
  EXPECT_EQ(corner("velocity = [0, 2, 0]", 3), RowVector3d(1, 7, 1));
  EXPECT_EQ(corner("keyframes = [{ time = 0, center = [0, 0, 0] }, { time = 2, center = [4, 0, 0] }]", 1),
            RowVector3d(3, 1, 1));
  // A quarter turn about z, around its own centre: (1, 1) becomes (−1, 1).
  EXPECT_LT((corner("orbit_period = 4", 1) - RowVector3d(-1, 1, 1)).norm(), 1e-14);
  EXPECT_LT((corner("center = [3, 0, 0]\norbit_period = 4", 1) - RowVector3d(-1, 4, 1)).norm(), 1e-14);
  EXPECT_LT((corner("rotate = [0, 0, 90]", 0) - RowVector3d(-1, 1, 1)).norm(), 1e-14);
}

TEST(SceneBodies, TurnOnKeyframes) {
  const SceneFolder folder;
  const auto corner = [&](const std::string& lines, double time) {
    return RowVector3d(shape_at(folder.load(with_body("box = [2, 2, 2]\n" + lines)), time).positions.row(7));
  };
  // From rotation 0 at 0 s, as for pins: a quarter turn about z in one second, then it stays.
  const std::string quarter = "rotations = [{ time = 1, rotate = [0, 0, 90] }]\n";
  EXPECT_EQ(corner(quarter, 0), RowVector3d(1, 1, 1));
  EXPECT_LT((corner(quarter, 0.5) - RowVector3d(0, std::sqrt(2.0), 1)).norm(), 1e-14);
  EXPECT_LT((corner(quarter, 3) - RowVector3d(-1, 1, 1)).norm(), 1e-14);
  // Around its own centre, on top of its initial rotation: first about the fixed x axis, then z.
  const std::string both = "rotate = [90, 0, 0]\n" + quarter + "velocity = [0, 0, 5]";
  EXPECT_LT((corner(both, 1) - RowVector3d(1, 1, 6)).norm(), 1e-14);
  EXPECT_LT((corner("rotations = [{ time = 0, rotate = [0, 0, 90] }]", 0) - RowVector3d(-1, 1, 1)).norm(), 1e-14);
  EXPECT_EQ(folder.problems(with_body("box = [1, 1, 1]\norbit_period = 2\n" + quarter)),
            "scene.toml:9:13: rotations: omit them on an orbit: the body turns with it");
}

TEST(SceneBodies, AreFilesWithYUpAndSequencesOfAnyRate) {
  const SceneFolder folder;
  folder.write("tent.obj", "v 0 0 0\nv 1 0 0\nv 0 2 0\nf 1 2 3\n");
  const MeshShape tent = shape_at(folder.load(with_body("file = { file = \"tent.obj\", up = \"y\" }")), 0);
  EXPECT_EQ(RowVector3d(tent.positions.row(2)), RowVector3d(0, 0, 2));
  folder.write("wave1.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  folder.write("wave2.obj", "v 0 0 0\nv 1 0 0\nv 0 1 8\nf 1 2 3\n");
  const Scene wave = folder.load(with_body("file = { file = \"wave{frame}.obj\", fps = 2 }"));
  EXPECT_EQ(shape_at(wave, 0.25).positions(2, 2), 4);
}

TEST(SceneBodies, SayWhatIsWrong) {
  const SceneFolder folder;
  EXPECT_EQ(folder.problems(with_body("thickness = 0.1")),
            "scene.toml:6:1: missing key 'box', 'file', 'cylinder', 'capsule', 'cone', 'plane' or 'sphere' in "
            "[effects.body]");
  EXPECT_EQ(folder.problems(with_body("box = [1, 1, 0]")).substr(0, 20), "scene.toml:7:14: box");
  EXPECT_EQ(folder.problems(with_body("box = [1, 1, 1]\nprim = \"/a\"")),
            "scene.toml:8:8: prim: names a mesh in a 'file', and there is none");
  EXPECT_NE(folder.problems(with_body("file = \"none.obj\"")).find("'none.obj' cannot be read"), std::string::npos);
}

TEST(SphereThickness, IsHowFarBeyondItsRadiusItPushes) {
  const SceneFolder folder;
  const auto reach = [&](const std::string& line) {
    const Scene scene = folder.load(least_scene + "[effects.sphere]\ncenter = [0, 0, -3]\nradius = 0.15\n" + line);
    return std::get<SphereShape>(Simulation(scene.simulation).colliders(0).at(0)).reach;
  };
  EXPECT_DOUBLE_EQ(reach(""), 0.165);
  EXPECT_DOUBLE_EQ(reach("thickness = 0.04"), 0.19);
  EXPECT_DOUBLE_EQ(reach("scale = 2"), 0.3);
  EXPECT_EQ(
      folder.problems(least_scene + "[effects.sphere]\ncenter = [0, 0, -3]\nradius = 1\nscale = 1.1\nthickness = 0.04"),
      "scene.toml:10:13: thickness: give only one of 'scale' and 'thickness': each says how far the push reaches");
}

/// Returns the overlap of a scene's cloth with the last of its effects.
std::optional<Overlap> overlap_of(const SceneFolder& folder, const std::string& effects,
                                  const std::string& cloth = "") {
  const Scene scene = folder.load((cloth.empty() ? least_scene : cloth) + effects);
  const SimulationSettings& settings = scene.simulation;
  return find_overlap(settings, settings.effects.size() - 1, settings.cloth.positions, 0);
}

// Nine vertices at z = 0, at 0 and ±1, in eight triangles.
TEST(Overlap, CountsVerticesInsideAndHowDeepTheyAre) {
  const SceneFolder folder;
  const auto sphere = overlap_of(folder, "[effects.sphere]\ncenter = [0, 0, -0.4]\nradius = 0.5\nscale = 3\n");
  ASSERT_TRUE(sphere);
  EXPECT_FALSE(sphere->contact);
  EXPECT_EQ(sphere->vertices, std::vector{4});
  EXPECT_NEAR(sphere->depth, 0.1, 1e-12);
  const auto ground = overlap_of(folder, "[effects.ground]\nheight = 0.25\nallow_overlap = true\n");
  ASSERT_TRUE(ground);
  EXPECT_TRUE(ground->contact);
  EXPECT_EQ(ground->vertices.size(), 9U);
  EXPECT_EQ(ground->triangles.size(), 8U);
  EXPECT_NEAR(ground->depth, 0.25, 1e-12);
  const auto box = overlap_of(folder, "[effects.body]\nbox = [1, 4, 1]\ncenter = [0, 0, 0.3]\nallow_overlap = true\n");
  ASSERT_TRUE(box);
  EXPECT_EQ(box->vertices, (std::vector{1, 4, 7}));
  EXPECT_EQ(box->triangles.size(), 8U);
  EXPECT_NEAR(box->depth, 0.2, 1e-12);
}

TEST(Overlap, IsNeitherASurfaceNorTheLayerAboveIt) {
  const SceneFolder folder;
  EXPECT_FALSE(overlap_of(folder, "[effects.ground]\nheight = 0\n"));
  EXPECT_FALSE(overlap_of(folder, "[effects.body]\nbox = [1, 1, 1]\ncenter = [0, 0, 0.5]\n"));
  EXPECT_FALSE(overlap_of(folder, "[effects.sphere]\ncenter = [0, 0, -1]\nradius = 0.95\nfriction = 0.2\n"));
}

// A pole through the middle of a triangle has no vertex of the cloth inside, nor has the cloth an edge in it.
TEST(Overlap, IsAlsoWhereABodyGoesThroughATriangle) {
  const SceneFolder folder;
  const std::string pole = "box = [0.1, 0.1, 2]\ncenter = [0.8, 0.6, 0]\n";
  const auto through = overlap_of(folder, "[effects.body]\nallow_overlap = true\n" + pole);
  ASSERT_TRUE(through);
  EXPECT_TRUE(through->vertices.empty());
  EXPECT_EQ(through->triangles.size(), 1U);
  const auto shell = overlap_of(folder,
                                "[effects.body]\nallow_overlap = true\nplane = { width = 0.1, depth = 4 }\nrotate = "
                                "[0, 90, 0]\ncenter = [0.5, 0, 0]\n");
  ASSERT_TRUE(shell);
  EXPECT_EQ(shell->triangles.size(), 4U);
}

TEST(Overlap, IsNotWhereAPinHoldsTheCloth) {
  const SceneFolder folder;
  const std::string pinned = "[cloth]\nmesh = { grid = [2, 2] }\nstiffness = 10\npins = [4]\n[time]\nstep = 0.01\n";
  EXPECT_FALSE(overlap_of(folder, "[effects.sphere]\ncenter = [0, 0, 0]\nradius = 0.5\nfriction = 0.1\n", pinned));
  EXPECT_FALSE(overlap_of(folder, "[effects.body]\nbox = [0.1, 0.1, 1]\n", pinned));
}

TEST(StartOverlap, IsAnErrorThatNamesTheTriangles) {
  const SceneFolder folder;
  EXPECT_EQ(folder.problems(least_scene + "[effects.ground]\nheight = 0.25\n"),
            "scene.toml:6:1: [effects.ground]: the cloth begins with 9 vertices inside the ground, up to 0.25 m deep, "
            "and 8 triangles (numbers 0, 1, 2, 3, 4 …), the first at [-0.667, -0.667, 0]: move one of the two, or set "
            "allow_overlap = true to have them separated step by step");
  EXPECT_EQ(folder.problems(least_scene + "[effects.body]\nbox = [0.1, 0.1, 2]\ncenter = [0.8, 0.6, 0]\n"),
            "scene.toml:6:1: [effects.body]: the cloth begins with 1 triangle (number 7) across the body, the first at "
            "[0.667, 0.667, 0]: move one of the two, or set allow_overlap = true to have them separated step by step");
  const std::string sphere = "[effects.sphere]\ncenter = [0, 0, 0]\nradius = 0.5\n";
  EXPECT_NE(folder.problems(least_scene + sphere + "friction = 0.1\n").find("1 vertex inside the sphere"),
            std::string::npos);
  EXPECT_EQ(start_overlaps(folder.load(least_scene + sphere).simulation).size(), 1U);
  EXPECT_EQ(
      start_overlaps(folder.load(least_scene + sphere + "friction = 0.1\nallow_overlap = true\n").simulation).size(),
      1U);
  EXPECT_EQ(folder.problems(least_scene + sphere + "allow_overlap = true\n"),
            "scene.toml:9:17: allow_overlap: is of contact; a sphere without friction, restitution and thickness "
            "pushes: omit it");
}

TEST(StartOverlap, OfAClothWithItselfIsAnError) {
  const SceneFolder folder;
  folder.write("pierced.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0.2 0.2 -1\nv 0.2 0.3 1\nv 0.3 0.2 1\nf 1 2 3\nf 4 5 6\n");
  const std::string cloth = "[cloth]\nmesh = { file = \"pierced.obj\" }\nstiffness = 10\n[time]\nstep = 0.01\n";
  EXPECT_EQ(folder.problems(cloth + "[effects.self_collision]\n"),
            "scene.toml:6:1: [effects.self_collision]: the cloth begins with 2 triangles (numbers 0, 1) across itself, "
            "the first at [0.333, 0.333, 0]: move one of the two, or set allow_overlap = true to have them separated "
            "step by step");
  EXPECT_EQ(folder.problems(cloth + "[effects.self_collision]\nallow_overlap = true\n"), "(no error)");
}

}  // namespace
}  // namespace drape
