// Selections of vertices in [cloth] pins and in effects, and their motions.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>

#include "drape/scene/scene.hpp"
#include "drape/sim/effects/moving_pins.hpp"
#include "scene/selection.hpp"
#include "tests/support/scene_folder.hpp"

namespace drape::scene_selection {
namespace {

using test::SceneFolder;

/// Returns a cloth of 4×4 cells, half a metre wide, or of another mesh.
std::string cloth(const std::string& pins, const std::string& mesh = "{ grid = [4, 4] }") {
  return "[cloth]\nmesh = " + mesh + "\nstiffness = 10\npins = [" + pins + "]\n";
}

std::vector<int> selected(const SceneFolder& folder, const std::string& pins,
                          const std::string& mesh = "{ grid = [4, 4] }") {
  return folder.load(cloth(pins, mesh)).simulation.cloth.pins;
}

TEST(SceneSelection, OfABallAndOfACircle) {
  const SceneFolder folder;
  EXPECT_EQ(selected(folder, "{ ball = { center = [0, 0, 0], radius = 0.5 } }"), (std::vector{7, 11, 12, 13, 17}));
  EXPECT_EQ(selected(folder, "{ circle = { center = [0, 0, 0], radius = 0.5, width = 0.1 } }"),
            (std::vector{7, 11, 13, 17}));
  EXPECT_EQ(selected(folder, "{ circle = { center = [0, 0, 0], radius = 1, width = 0.1, normal = [0, 2, 0] } }"),
            (std::vector{10, 14}));
}

TEST(SceneSelection, OfTheBorderInItsOrder) {
  const SceneFolder folder;
  const std::vector<int> all = {0, 1, 2, 3, 4, 5, 9, 10, 14, 15, 19, 20, 21, 22, 23, 24};
  EXPECT_EQ(selected(folder, "{ border = \"all\" }"), all);
  EXPECT_EQ(selected(folder, "{ border = \"z+\" }"), all) << "there is but one ring";
  EXPECT_EQ(selected(folder, "{ border = \"all\", every = 4 }"), (std::vector{0, 4, 20, 24}))
      << "corners, along the ring";
  EXPECT_EQ(selected(folder, "{ ball = { center = [0, 0, 0], radius = 9 }, every = 10 }"), (std::vector{0, 10, 20}));
  // A tube of three sides: one ring below, one above.
  folder.write("tube.obj",
               "v 1 0 0\nv 0 1 0\nv -1 -1 0\nv 1 0 2\nv 0 1 2\nv -1 -1 2\nf 1 2 5 4\nf 2 3 6 5\nf 3 1 4 6\n");
  EXPECT_EQ(selected(folder, "{ border = \"z+\" }", "\"tube.obj\""), (std::vector{3, 4, 5}));
  EXPECT_EQ(selected(folder, "{ border = \"z-\" }", "\"tube.obj\""), (std::vector{0, 1, 2}));
  EXPECT_EQ(border_rings(make_grid(1, 1).triangles), (std::vector<std::vector<int>>{{0, 1, 3, 2}}));
}

// drape writes the groups of the cloths first, then an object for each obstacle.
TEST(SceneSelection, ByAGroupOfAFrameThatDrapeWroteEndsWithTheCloth) {
  const SceneFolder folder;
  folder.write("frame.obj",
               "# drape: frame 0 at 0 s, in metres, z up\no cloth\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 5\nv 1 0 5\nv 0 1 "
               "5\ng cover\nf 1 2 3\ng napkin\nf 4 5 6\no body1\nv 0 0 9\nv 1 0 9\nv 0 1 9\nf 7 8 9\n");
  EXPECT_EQ(selected(folder, "{ group = \"napkin\" }", "\"frame.obj\""), (std::vector{3, 4, 5}));
  EXPECT_EQ(folder.problems(cloth("{ group = \"body1\" }", "\"frame.obj\"")),
            "scene.toml:4:19: pins[0].group: 'body1' is no part of the cloth");
  folder.write("other.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 5\ng hem\no skirt\nf 1 2 3\no belt\nf 1 3 4\n");
  EXPECT_EQ(selected(folder, "{ group = \"hem\" }", "\"other.obj\""), (std::vector{0, 1, 2}));
}

TEST(SceneSelection, ByTheNamesOfAFile) {
  const SceneFolder folder;
  folder.write("a.obj",
               "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 5 5 5\nv 6 5 5\nv 5 6 5\no skirt\nf 1 2 3\ng hem waist\nf 4 5 6\n");
  EXPECT_EQ(selected(folder, "{ group = \"waist\" }", "\"a.obj\""), (std::vector{3, 4, 5}));
  EXPECT_EQ(selected(folder, "{ group = \"skirt\", every = 5 }", "\"a.obj\""), (std::vector{0, 5}));
  EXPECT_NE(
      folder.problems(cloth("{ group = \"waists\" }", "\"a.obj\""))
          .find("scene.toml:4:19: pins[0].group: a.obj: there is no group or object 'waists' in the file; did you mean "
                "'waist'?"),
      std::string::npos)
      << folder.problems(cloth("{ group = \"waists\" }", "\"a.obj\""));
  folder.write(
      "a.usda",
      "#usda 1.0\ndef Mesh \"m\" {\nint[] faceVertexCounts = [3]\nint[] faceVertexIndices = [0, 1, 2]\npoint3f[] "
      "points = [(0, 0, 0), (1, 0, 0), (0, 1, 0)]\nbool[] primvars:held = [true, 0, 1] ( interpolation = "
      "\"vertex\" )\nfloat[] primvars:one = [1]\n}\n");
  EXPECT_EQ(selected(folder, "{ primvar = \"held\" }", "\"a.usda\""), (std::vector{0, 2}));
  EXPECT_EQ(selected(folder, "{ primvar = \"held\" }", "{ file = \"a.usda\", prim = \"/m\" }"), (std::vector{0, 2}));
  const auto problem = [&](const std::string& pins, const std::string& mesh) {
    return folder.problems(cloth(pins, mesh));
  };
  EXPECT_EQ(problem("{ primvar = \"one\" }", "\"a.usda\""),
            "scene.toml:4:21: pins[0].primvar: a.usda:7:24: primvars:one: expected a number for each of the 3 points, "
            "found 1");
  EXPECT_EQ(
      problem("{ primvar = \"seam\" }", "\"a.usda\""),
      "scene.toml:4:21: pins[0].primvar: a.usda:2:1: the Mesh 'm' has no primvars:seam; its primvars of one number "
      "are 'held', 'one'");
  EXPECT_EQ(problem("{ primvar = \"hold\" }", "\"a.usda\""),
            "scene.toml:4:21: pins[0].primvar: a.usda:2:1: the Mesh 'm' has no primvars:hold; did you mean 'held'?");
  EXPECT_EQ(problem("{ primvar = \"one\" }", "\"a.obj\""),
            "scene.toml:4:21: pins[0].primvar: a.obj: only a USD file has primvars");
  EXPECT_EQ(problem("{ group = \"one\" }", "{ grid = [2, 2] }"),
            "scene.toml:4:19: pins[0].group: grid: only an OBJ has groups");
}

TEST(SceneSelection, SaysWhatIsWrong) {
  const SceneFolder folder;
  const auto problem = [&](const std::string& pins) { return folder.problems(cloth(pins)); };
  EXPECT_EQ(problem("{ ball = { center = [9, 9, 9], radius = 1 } }"),
            "scene.toml:4:18: pins[0].ball: no vertex of the mesh is in this ball");
  EXPECT_EQ(problem("{ ball = { centre = [9, 9, 9], radius = 1 } }"),
            "scene.toml:4:20: pins[0].ball: unknown key 'centre'; did you mean 'center'?");
  EXPECT_EQ(problem("{ circle = { center = [0, 0, 0], radius = 1 } }"),
            "scene.toml:4:20: pins[0].circle: missing key 'width'");
  EXPECT_EQ(problem("{ border = \"up\" }"),
            "scene.toml:4:20: pins[0].border: expected 'all' or a direction like 'z+', found 'up'");
  EXPECT_EQ(problem("{ border = \"all\", every = 0 }"), "scene.toml:4:35: pins[0].every must be at least 1, found 0");
  EXPECT_EQ(problem("{ border = \"all\", box = [[0, 0, 0], [1, 1, 1]] }"),
            "scene.toml:4:27: pins[0]: a selection has one form, and 'border' is given");
}

TEST(SceneFollow, ReadsTheMeshThatPinsHoldOnTo) {
  const SceneFolder folder;
  folder.write("lift.usda",
               "#usda 1.0\n(\nupAxis = \"Z\"\nmetersPerUnit = 1\n)\ndef Mesh \"m\" {\nint[] faceVertexCounts = [3]\n"
               "int[] faceVertexIndices = [0, 1, 2]\npoint3f[] points.timeSamples = { 0: [(0, 0, 0), (1, 0, 0), (0, 1, "
               "0)], 24: [(0, 0, 1), (1, 0, 1), (0, 1, 1)] }\n}\n");
  const std::string table = "[effects.moving_pins]\npins = [{ border = \"all\", every = 4 }]\nfollow = ";
  const LoadedScene scene =
      folder.load(cloth("{ border = \"all\" }") + table + "{ file = \"lift.usda\", prim = \"/m\" }\n");
  const auto* pins = scene.simulation.effects.begin()->as<MovingPins>();
  ASSERT_NE(pins, nullptr);
  EXPECT_EQ(pins->pins, (std::vector{0, 4, 20, 24}));
  ASSERT_NE(pins->follow, nullptr);
  EXPECT_EQ(pins->follow->times, (std::vector<double>{0, 1}));
  const auto named = [](const std::filesystem::path& input) { return input.filename() == "lift.usda"; };
  EXPECT_EQ(std::ranges::count_if(scene.source.inputs, named), 1);
  EXPECT_NE(scene.source.portable.text.find("file = \"file-1.usda\", prim = \"/m\""), std::string::npos)
      << scene.source.portable.text;

  folder.write("body/008.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  folder.write("body/009.obj", "v 0 0 2\nv 1 0 2\nv 0 1 2\nf 1 2 3\n");
  const LoadedScene played =
      folder.load(cloth("{ border = \"all\" }") + table + "{ file = \"body/{frame:03}.obj\", fps = 4 }\n");
  EXPECT_EQ(played.simulation.effects.begin()->as<MovingPins>()->follow->times, (std::vector<double>{0, 0.25}));
  EXPECT_NE(played.source.portable.text.find("\"file-1-{frame:03}.obj\""), std::string::npos)
      << played.source.portable.text;
  ASSERT_EQ(played.source.portable.files.size(), 2U);
  EXPECT_EQ(played.source.portable.files[1].name, "file-1-009.obj");
  EXPECT_NE(folder.problems(cloth("0") + "[effects.moving_pins]\npins = [0]\nfollow = { file = \"nowhere.usda\" }\n")
                .find("scene.toml:7:10: follow: 'nowhere.usda' cannot be read:\nnowhere.usda: no such file"),
            std::string::npos);
  EXPECT_EQ(
      folder.problems(cloth("0") + "[effects.moving_pins]\npins = [0]\nfollow = \"lift.usda\"\nrotations = [{ time = "
                                   "1, rotate = [0, 0, 90] }]\n"),
      "scene.toml:7:10: follow: the mesh already says how they move: omit 'keyframes' and 'rotations'");
  EXPECT_EQ(
      folder.problems(cloth("0") + "[effects.moving_pins]\npins = [0]\nfollow = \"body/008.obj\"\n"),
      "scene.toml:7:10: follow: the mesh does not move, so the pins would stay where they are, as they do without "
      "this table");
}

// A motion file contains all files of its scene's folder, so it can be computed anywhere.
TEST(SceneFollow, CarriesWhatAUsdFileRefersTo) {
  const SceneFolder folder;
  folder.write(
      "parts/part.usda",
      "#usda 1.0\ndef Mesh \"m\" {\nint[] faceVertexCounts = [3]\nint[] faceVertexIndices = [0, 1, 2]\npoint3f[] "
      "points = [(0, 0, 0), (1, 0, 0), (0, 1, 0)]\n}\n");
  folder.write("whole.usda", "#usda 1.0\ndef \"a\" ( references = @parts/part.usda@</m> ) {}\n");
  const LoadedScene scene = folder.load(cloth("0", "\"whole.usda\""));
  const std::filesystem::path place = folder.path() / "moved";
  for (const PortableScene::File& file : scene.source.portable.files) {
    std::filesystem::create_directories(place);
    std::filesystem::copy_file(file.place, place / file.name);
  }
  const Scene again = load_scene(folder.write("moved/scene.toml", scene.source.portable.text));
  EXPECT_EQ(again.simulation.cloth.positions, scene.simulation.cloth.positions);
}

}  // namespace
}  // namespace drape::scene_selection
