// Structured values in the tables of effects.

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "drape/sim/simulation.hpp"
#include "scene/usd/motion.hpp"
#include "sim/system.hpp"
#include "tests/support/scene_folder.hpp"

namespace drape {
namespace {

using Eigen::Vector3d;
using test::least_scene;
using test::SceneFolder;

/// Returns the least scene's five lines, followed by the effect's table from line 7 on.
std::string with(const std::string& effect, const std::string& lines) {
  return least_scene + "[effects." + effect + "]\n" + lines + "\n";
}

SphereShape sphere_at(const Scene& scene, double time) {
  return std::get<SphereShape>(Simulation(scene.simulation).colliders(time).at(0));
}

TEST(SceneEffects, ASphereMovesStraightInCirclesOrThroughKeyframes) {
  const SceneFolder folder;
  const std::string ball = "center = [1, 0, 0]\nradius = 0.5\n";
  EXPECT_EQ(sphere_at(folder.load(with("sphere", ball + "velocity = [0, 2, 0]")), 3).center, Vector3d(1, 6, 0));
  const Scene circling = folder.load(with("sphere", ball + "orbit_period = 4\norbit_center = [0, 0, 9]"));
  EXPECT_LT((sphere_at(circling, 1).center - Vector3d(0, 1, 0)).norm(), 1e-15);
  const Scene keyed = folder.load(
      with("sphere", "radius = 0.5\nkeyframes = [{ time = 1, center = [0, 0, 2] }, { center = [4, 0, 2], time = 3 }]"));
  EXPECT_EQ(sphere_at(keyed, 2).center, Vector3d(2, 0, 2));
}

TEST(SceneEffects, ASphereMovesInOneWayOnly) {
  const SceneFolder folder;
  EXPECT_EQ(folder.problems(with("sphere", "radius = 1")),
            "scene.toml:6:1: missing key 'center', 'keyframes' or 'track' in [effects.sphere]");
  EXPECT_EQ(folder.problems(with("sphere", "center = [0, 0, 0]\nradius = 1\nvelocity = [1, 0, 0]\norbit_period = 2")),
            "scene.toml:6:1: [effects.sphere]: give only one of 'velocity', 'orbit_period', 'keyframes' and 'track': "
            "each defines the motion");
  EXPECT_EQ(
      folder.problems(with("sphere", "center = [0, 0, 0]\nradius = 1\nkeyframes = [{ time = 0, center = [0, 0, 0] }]")),
      "scene.toml:7:10: center: 'keyframes' already says where its centre is");
  EXPECT_EQ(folder.problems(with("sphere", "center = [0, 0, 0]\nradius = 1\norbit_period = 0\norbit_axis = [0, 0, 0]")),
            "scene.toml:9:16: orbit_period: expected a time other than 0\n"
            "scene.toml:10:14: orbit_axis: expected a direction, found [0, 0, 0]");
}

TEST(SceneEffects, KeyframesAreReadStrictly) {
  const SceneFolder folder;
  const auto said = [&](const std::string& keyframes) {
    return folder.problems(with("sphere", "radius = 1\nkeyframes = " + keyframes));
  };
  EXPECT_EQ(said("3"),
            "scene.toml:8:13: keyframes: expected an array of { time = …, center = [x, y, z] }, found a whole "
            "number");
  EXPECT_EQ(said("[]"),
            "scene.toml:8:13: keyframes: expected an array of { time = …, center = [x, y, z] }, found an "
            "empty one");
  EXPECT_EQ(said("[[1, 2, 3]]"),
            "scene.toml:8:14: keyframes[0]: expected { time = …, center = [x, y, z] }, found an array");
  EXPECT_EQ(said("[{ tim = 1, center = [0, 0, 0] }]"),
            "scene.toml:8:16: keyframes[0]: unknown key 'tim'; did you mean 'time'?");
  EXPECT_EQ(said("[{ time = 1 }]"), "scene.toml:8:14: keyframes[0]: missing key 'center'");
  EXPECT_EQ(said("[{ time = -1, center = [0, 0, 0] }]"),
            "scene.toml:8:23: keyframes[0].time must be at least 0, found -1");
  EXPECT_EQ(
      said("[{ time = 1, center = [0, 0, 0] }, { time = 1, center = [0, 0, 0] }]"),
      "scene.toml:8:57: keyframes[1].time: keyframes must follow each other in time, and the one before is at 1 s, "
      "found 1");
  EXPECT_EQ(said("[{ time = -1, center = [0, 0, 0] }, { time = 1 }, { tim = 2, center = [0, 0, 0] }]"),
            "scene.toml:8:23: keyframes[0].time must be at least 0, found -1\n"
            "scene.toml:8:49: keyframes[1]: missing key 'center'\n"
            "scene.toml:8:65: keyframes[2]: unknown key 'tim'; did you mean 'time'?");
  EXPECT_EQ(said("[{ time = 1, center = [0, 0] }]"),
            "scene.toml:8:35: keyframes[0].center: expected an array of 3 numbers, found one of 2");
}

TEST(SceneEffects, PinsAreMovedInTheFormsInWhichTheyArePinned) {
  const SceneFolder folder;
  const std::string pinned =
      "[cloth]\nmesh = { grid = [2, 2] }\nstiffness = 10\npins = [{ box = [[-1, -1, 0], [1, -1, 0]] }]\n"
      "[cloth.transform]\nscale = 3\ntranslate = [0, 0, 7]\n[effects.moving_pins]\n";
  // Boxes and corners refer to the mesh before its transform, as in [cloth].
  const Scene scene =
      folder.load(pinned + "pins = [{ box = [[-1, -1, 0], [0.5, -1, 0]] }, \"corner:x+y-\"]\nrelease = 1");
  EXPECT_EQ(make_system(scene.simulation).pin_releases.at(0).vertices, (std::vector{0, 1, 2}));
  EXPECT_EQ(make_system(scene.simulation).pin_releases.at(0).step, 100);
  EXPECT_EQ(folder.problems(pinned + "pins = [8]\nrelease = 1"),
            "scene.toml:9:8: pins: vertex 8 is not pinned; add it to [cloth] pins");
  EXPECT_EQ(folder.problems(pinned + "pins = [9]\nrelease = 1"),
            "scene.toml:9:9: pins[0]: the mesh has the vertices 0 to 8, found 9");
  EXPECT_EQ(folder.problems(pinned + "pins = [0]\nkeyframes = [{ time = 1, offset = [0, 0, 1] }, "
                                     "{ time = 2, position = [0, 0, 1] }]"),
            "scene.toml:10:60: keyframes[1]: every keyframe of a list has the same key, and before this one it was "
            "'offset'");
}

TEST(SceneEffects, AGroundNeedsANormal) {
  const SceneFolder folder;
  EXPECT_EQ(folder.problems(with("ground", "height = 0\nnormal = [0, 0, 0]")),
            "scene.toml:8:10: normal: expected a direction, found [0, 0, 0]");
  const Scene scene = folder.load(with("ground", "height = -2\nnormal = [0, 3, 4]"));
  const auto shape = std::get<GroundShape>(Simulation(scene.simulation).colliders(0).at(0));
  EXPECT_LT((shape.normal - Vector3d(0, 0.6, 0.8)).norm(), 1e-15);
  EXPECT_EQ(shape.height, -2);
}

TEST(SceneEffects, ASphereFollowsAUsdFile) {
  const SceneFolder folder;
  const std::string header =
      "#usda 1.0\n( startTimeCode = 0\ntimeCodesPerSecond = 10\nmetersPerUnit = 1\nupAxis = \"Z\" )\n";
  const std::string moves =
      "double3 xformOp:translate.timeSamples = { 0: (1, 0, 0), 20: (3, 0, 0) }\n"
      "uniform token[] xformOpOrder = [\"xformOp:translate\"]\n";
  folder.write("ball.usda", header + "def Sphere \"ball\" {\ndouble radius = 0.25\n" + moves + "}\n");
  folder.write("point.usda", header + "def Xform \"point\" {\n" + moves + "}\n");
  const Scene scene = folder.load(with("sphere", "track = \"ball.usda\""));
  EXPECT_EQ(sphere_at(scene, 1).center, Vector3d(2, 0, 0));
  EXPECT_EQ(sphere_at(scene, 1).radius, 0.25);
  EXPECT_EQ(sphere_at(folder.load(with("sphere", "track = \"point.usda\"\nradius = 0.4")), 2).radius, 0.4);
  EXPECT_EQ(folder.problems(with("sphere", "track = \"point.usda\"")),
            "scene.toml:7:9: track: the moving object in this file has no size: also give the 'radius'");
  const std::string missing = folder.problems(with("sphere", "track = \"balls.usda\""));
  EXPECT_EQ(missing.substr(0, 57), "scene.toml:7:9: track: 'balls.usda' cannot be read:\nballs");
}

TEST(SceneEffects, TheAnimatedSpherePlaysAsItWasAuthored) {
  const char* reference = std::getenv("DRAPE_REFERENCE_MESHES");
  const auto file =
      std::filesystem::path(reference != nullptr ? reference : DRAPE_SOURCE_DIR "/../shared/reference/meshes") /
      "animated_sphere.usda";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "no " << file << ": set DRAPE_REFERENCE_MESHES to its folder";
  const SceneFolder folder;
  const Scene scene = folder.load(with("sphere", "track = '" + std::filesystem::absolute(file).string() + "'"));
  // Samples as in the file: time codes 1 to 250 at 24 per second, the first at 0 s. The centre is that of the mesh's
  // points, which are in single precision.
  const std::pair<double, double> samples[] = {
      {0, 0.0008330001146532595}, {1 / 24.0, 0.0033040004782378674}, {45 / 24.0, 1.09608793258667}};
  for (const auto& [time, y] : samples) EXPECT_LT((sphere_at(scene, time).center - Vector3d(0, y, 0)).norm(), 1e-6);
  EXPECT_NEAR(sphere_at(scene, 45 / 24.0).radius, 1, 1e-6);
}

}  // namespace
}  // namespace drape
