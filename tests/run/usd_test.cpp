#include <gtest/gtest.h>

#include <map>
#include <regex>
#include <sstream>

#include "scene/mesh_value.hpp"
#include "scene/usd/mesh.hpp"
#include "scene/usd/motion.hpp"
#include "scene/usd/stage.hpp"
#include "tests/support/written_motion.hpp"

namespace drape::usd {
namespace {

/// Rounds points to single precision, as in a USD file.
Vertices single(const Vertices& x) { return x.cast<float>().cast<double>(); }

/// Returns an attribute's time samples: the numbers of each time code. The reader of scene/ keeps the first of points.
std::map<int, std::vector<float>> samples(const std::string& usda, const std::string& attribute) {
  std::map<int, std::vector<float>> found;
  std::istringstream text(usda.substr(usda.find(attribute + ".timeSamples = {")));
  std::string line;
  std::getline(text, line);
  while (std::getline(text, line) && line.find('}') == std::string::npos) {
    std::istringstream words(std::regex_replace(line, std::regex("[:\\[\\](),]"), " "));
    int code = 0;
    words >> code;
    for (std::string number; words >> number;) found[code].push_back(std::strtof(number.c_str(), nullptr));
  }
  return found;
}

TEST(Usd, ReadsBackAsTheFramesOfTheFilm) {
  const test::SceneFolder folder;
  const LoadedScene scene = folder.load(test::moving_scene, {"video.speed=0.5"});
  RunOptions options;
  options.frames = FrameRange{2, 12};
  const auto [result, frames] = test::write_motion(scene, {folder.path("x.usda")}, options);
  ASSERT_EQ(frames.size(), 11U);
  const SourceText source = SourceText::read(folder.path("x.usda"));
  const UsdStage stage(source);
  EXPECT_TRUE(stage.layer().z_up);
  EXPECT_EQ(stage.layer().metres_per_unit, 1);
  EXPECT_EQ(stage.layer().start_time_code, 2);
  EXPECT_EQ(stage.layer().time_codes_per_second, 40);  // in the scene's time; the film plays 20 at half speed
  ASSERT_EQ(stage.prims().size(), 1U);
  const UsdPrim& cloth = stage.prims()[0].children.at(0);
  EXPECT_EQ(cloth.type, "Mesh");
  EXPECT_NE(cloth.find("points"), nullptr);
  const auto points = samples(test::content(folder.path("x.usda")), "points");
  ASSERT_EQ(points.size(), frames.size());
  for (const Frame& frame : frames) {
    const std::vector<float>& numbers = points.at(frame.index);
    ASSERT_EQ(numbers.size(), 60U);
    for (Eigen::Index i = 0; i < 60; ++i) {
      EXPECT_EQ(numbers[static_cast<std::size_t>(i)], static_cast<float>(frame.positions(i / 3, i % 3)));
    }
  }
}

TEST(Usd, ReadsBackAsAMesh) {
  const test::SceneFolder folder;
  const LoadedScene scene = folder.load(test::moving_scene);
  const auto [result, frames] = test::write_motion(scene, {folder.path("x.usda")});
  const Mesh mesh = read_mesh(folder.path("x.usda"));
  EXPECT_LT((mesh.positions - single(frames[0].positions)).cwiseAbs().maxCoeff(), 1e-7);
  EXPECT_EQ(mesh.triangles, scene.simulation.cloth.triangles);
  EXPECT_EQ(mesh.uvs, scene.uvs);
}

TEST(Usd, ItsSphereMovesAsTheScenes) {
  const test::SceneFolder folder;
  const auto [result, frames] = test::write_motion(folder.load(test::moving_scene), {folder.path("x.usda")});
  const SourceText source = SourceText::read(folder.path("x.usda"));
  const UsdStage stage(source);
  const std::vector<UsdPrim>& prims = stage.prims().at(0).children;
  std::vector<std::string> types;
  for (const UsdPrim& prim : prims) types.push_back(prim.type);
  EXPECT_EQ(types, (std::vector<std::string>{"Mesh", "Material", "Sphere", "Plane"}));
  const UsdAttribute* place = prims.at(2).find("xformOp:translate");
  ASSERT_NE(place, nullptr);
  ASSERT_EQ(place->samples.size(), frames.size());
  for (std::size_t k = 0; k < frames.size(); ++k) {
    const auto& sphere = std::get<SphereShape>(frames[k].colliders[0]);
    for (int i = 0; i < 3; ++i)
      EXPECT_EQ(place->samples[k].value.numbers[static_cast<std::size_t>(i)], sphere.center[i]);
  }
  EXPECT_EQ(prims[2].find("radius")->first()->numbers, std::vector<double>{0.3});
}

TEST(Usd, ItsSphereIsATrackForAnotherScene) {
  const test::SceneFolder folder;
  const auto [result, frames] =
      test::write_motion(folder.load(test::moving_scene, {"video.speed=2"}), {folder.path("x.usda")});
  const TransformTrack track = read_usd_motion(std::filesystem::path(folder.path("x.usda")));
  for (const Frame& frame : frames) {
    const auto& sphere = std::get<SphereShape>(frame.colliders[0]);
    EXPECT_LT((track.sphere_at(frame.time).center - sphere.center).norm(), 1e-14) << frame.time;
    EXPECT_NEAR(track.sphere_at(frame.time).radius, 0.3, 1e-14);
  }
}

TEST(Usd, ItsGroundLiesWhereItLies) {
  const test::SceneFolder folder;
  const LoadedScene scene = folder.load(test::moving_scene, {"effects.ground.normal=[0.6,0,0.8]"});
  test::write_motion(scene, {folder.path("x.usda")});
  const SourceText source = SourceText::read(folder.path("x.usda"));
  const UsdStage stage(source);
  const std::vector<double>& m = stage.prims().at(0).children.at(3).find("xformOp:transform")->first()->numbers;
  ASSERT_EQ(m.size(), 16U);
  EXPECT_NEAR(m[8], 0.6, 1e-15);  // the image of z, the normal of USD's plane
  EXPECT_NEAR(m[10], 0.8, 1e-15);
  EXPECT_NEAR(0.6 * m[12] + 0.8 * m[14], -1.25, 1e-15);
}

TEST(Usd, NamesEveryClothDifferently) {
  const test::SceneFolder folder;
  std::string scene = "[time]\nstep = 0.02\nduration = 0.02\n";
  for (const char* name : {"a-b", "a_b", "a-b_2", "a-b-2"}) {
    scene += std::string("[[cloth]]\nname = \"") + name + "\"\nmesh = { grid = [1, 1] }\nstiffness = 9\n";
  }
  test::write_motion(folder.load(scene), {folder.path("x.usda")});
  const SourceText source = SourceText::read(folder.path("x.usda"));
  const UsdStage stage(source);
  std::vector<std::string> subsets, materials;
  for (const UsdPrim& prim : stage.prims().at(0).children) {
    if (prim.type == "Material") materials.push_back(prim.name);
    for (const UsdPrim& child : prim.children) {
      if (child.type == "GeomSubset") subsets.push_back(child.name);
    }
  }
  EXPECT_EQ(subsets, (std::vector<std::string>{"a_b_2", "a_b", "a_b_2_2", "a_b_2_3"}));
  for (std::string& name : subsets) name = "Material_" + name;
  EXPECT_EQ(materials, subsets);
}

TEST(Usd, NamesTheTextureAsSeenFromItsFolder) {
  const test::SceneFolder folder;
  folder.write("pictures/mine.png", "");
  const LoadedScene scene = folder.load(test::moving_scene, {"look.texture=\"pictures/mine.png\""});
  test::write_motion(scene, {folder.path("x.usda"), folder.path("deep/y.usda")});
  EXPECT_NE(test::content(folder.path("x.usda")).find("inputs:file = @./pictures/mine.png@"), std::string::npos);
  EXPECT_NE(test::content(folder.path("deep/y.usda")).find("inputs:file = @../pictures/mine.png@"), std::string::npos);
}

}  // namespace
}  // namespace drape::usd
