#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "drape/scene/scene.hpp"
#include "scene/selection.hpp"
#include "tests/support/scene_folder.hpp"

namespace drape {
namespace {

using test::SceneFolder;

constexpr double tiny = 1e-15;

/// Returns a cloth of 2×2 cells, with more lines in [cloth] from line 4 on.
std::string cloth(const std::string& lines) {
  return "[cloth]\nmesh = { grid = [2, 2] }\nstiffness = 10\n" + lines + "\n";
}

std::vector<int> pins(const SceneFolder& folder, const std::string& text) {
  return folder.load(cloth("pins = " + text)).simulation.cloth.pins;
}

TEST(SceneMesh, AGridHasItsColumnsAndRows) {
  const SceneFolder folder;
  const Scene scene = folder.load("[cloth]\nmesh = { grid = [3, 2] }\nstiffness = 7\nmass = 6\n");
  const Cloth& c = scene.simulation.cloth;
  EXPECT_EQ(c.vertex_count(), 12);
  EXPECT_EQ(c.triangles.size(), 12U);
  EXPECT_EQ(c.springs.size(), 9U + 8U + 6U);
  EXPECT_EQ(scene.uvs.size(), 36U);
  EXPECT_DOUBLE_EQ(c.masses.sum(), 6);
  for (const Spring& spring : c.springs) EXPECT_EQ(spring.stiffness, 7);
  EXPECT_TRUE(c.pins.empty());
}

TEST(SceneMesh, AFileIsBesideTheScene) {
  const SceneFolder folder;
  folder.write("meshes/one.obj", "v 0 0 0\nv 2 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n");
  const Scene scene = folder.load("[cloth]\nmesh = \"meshes/one.obj\"\nstiffness = 7\n");
  EXPECT_EQ(scene.simulation.cloth.vertex_count(), 3);
  EXPECT_EQ(scene.simulation.cloth.springs.front().rest_length, 2);
  EXPECT_EQ(scene.uvs.size(), 3U);
}

TEST(SceneMesh, AFaultyFileIsNamedUnderItsPlaceInTheScene) {
  const SceneFolder folder;
  folder.write("bad.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n");
  const std::string problem = folder.problems("[cloth]\nmesh = \"bad.obj\"\nstiffness = 0\n");
  EXPECT_EQ(problem.substr(0, problem.find('\n')), "scene.toml:2:8: mesh: 'bad.obj' cannot be read:");
  EXPECT_NE(problem.find("\nbad.obj:4"), std::string::npos) << problem;
  EXPECT_NE(problem.find("\nscene.toml:3:13: stiffness must be above 0, found 0"), std::string::npos) << problem;
}

TEST(SceneMesh, IsChosenByItsNameAndTurnedByItsUpAxis) {
  const SceneFolder folder;
  folder.write(
      "two.usda",
      "#usda 1.0\n(\nupAxis = \"Z\"\nmetersPerUnit = 1\n)\ndef Mesh \"a\" {}\ndef Xform \"b\" {\ndef Mesh \"c\" "
      "{\nint[] faceVertexCounts = [3]\nint[] faceVertexIndices = [0, 1, 2]\npoint3f[] points = [(0, 0, 0), (1, 0, "
      "0), (0, 1, 0)]\n}\n}\n");
  folder.write("lying.obj", "v 0 0 0\nv 1 0 0\nv 0 1 2\nf 1 2 3\n");
  const LoadedScene chosen = folder.load("[cloth]\nmesh = { file = \"two.usda\", prim = \"/b/c\" }\nstiffness = 7\n");
  EXPECT_EQ(chosen.simulation.cloth.vertex_count(), 3);
  ASSERT_EQ(chosen.source.inputs.size(), 2U);
  EXPECT_EQ(chosen.source.inputs[0].filename(), "two.usda") << chosen.source.inputs[0];
  const Scene turned = folder.load("[cloth]\nmesh = { file = \"lying.obj\", up = \"y\" }\nstiffness = 7\n");
  EXPECT_EQ(turned.simulation.cloth.positions.row(2), Eigen::RowVector3d(0, -2, 1));
}

// Possible mistakes only cause warnings: the scene is simulated.
TEST(SceneMesh, DoubtsSizesAndUpAxesThatAreSeldomMeant) {
  const SceneFolder folder;
  const auto warnings = [&](const std::string& mesh, const std::string& more = "") {
    return folder.load("[cloth]\nmesh = " + mesh + "\nstiffness = 7\n" + more).source.warnings;
  };
  const std::string scaled = "[cloth.transform]\nscale = ";
  EXPECT_TRUE(warnings("{ grid = [2, 2] }").empty());
  EXPECT_TRUE(warnings("{ grid = [2, 2] }", scaled + "50").empty());
  const std::vector<std::string> large = warnings("{ grid = [2, 2] }", scaled + "167");
  ASSERT_EQ(large.size(), 1U);
  EXPECT_TRUE(
      large[0].ends_with("scene.toml:2:8: mesh: the cloth is 334 m large: are its coordinates metres? "
                         "[cloth.transform] scale changes them"))
      << large[0];
  EXPECT_EQ(warnings("{ grid = [2, 2] }", scaled + "4e-4").size(), 1U);

  folder.write("shirt.obj", "v -0.4 0.9 -0.1\nv 0.4 0.9 0.15\nv 0 1.5 0\nf 1 2 3\n");  // on a floor at y = 0
  folder.write("table.obj", "v -1 3 -1\nv 1 3 1\nv 1 3.1 -1\nf 1 2 3\n");              // flat in y
  folder.write("flag.obj", "v -1 0 3\nv 1 1 3\nv 1 -1 3.1\nf 1 2 3\n");                // flat in z
  for (const char* file : {"\"shirt.obj\"", "\"table.obj\""}) {
    ASSERT_EQ(warnings(file).size(), 1U) << file;
    EXPECT_NE(warnings(file)[0].find(std::string("write { file = ") + file + ", up = \"y\" }"), std::string::npos)
        << warnings(file)[0];
  }
  EXPECT_TRUE(warnings("\"flag.obj\"").empty());
  EXPECT_TRUE(warnings("{ file = \"shirt.obj\", up = \"z\" }").empty());
  EXPECT_TRUE(warnings("\"shirt.obj\"", "[cloth.transform]\nrotate = [90, 0, 0]\n").empty());
}

TEST(SceneLook, SaysOfAColourThatATextureCoversThatItIsNotSeen) {
  const SceneFolder folder;
  const std::string cloth = "[cloth]\nmesh = { grid = [2, 2] }\nstiffness = 7\n[look]\n";
  const std::vector<std::string> warnings =
      folder.load(cloth + "texture = \"plaid.png\"\ncolor = \"red\"\n").source.warnings;
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_TRUE(warnings[0].ends_with(
      "scene.toml:6:9: color: it is not seen, because the texture covers the cloth: omit one of the two"))
      << warnings[0];
  EXPECT_TRUE(folder.load(cloth + "color = \"red\"\n").source.warnings.empty());
  EXPECT_TRUE(folder.load(cloth + "texture = \"plaid.png\"\n").source.warnings.empty());
}

TEST(SceneMesh, SaysItsPiecesItsExtentAndItsEdges) {
  const SceneFolder folder;
  folder.write("two.obj", "v 0 0 0\nv 3 0 0\nv 0 4 0\nv 0 0 7\nv 1 0 7\nv 0 1 7\nv 9 9 9\nf 1 2 3\nf 4 5 6\n");
  const Scene scene = folder.load("[cloth]\nmesh = \"two.obj\"\nstiffness = 7\n");
  EXPECT_EQ(shape_of(scene.simulation.cloth).text(), "2 pieces of 9 × 9 × 9 m together, edges of 1 to 5 m");
  const Scene grid = folder.load("[cloth]\nmesh = { grid = [4, 4] }\nstiffness = 7\n");
  EXPECT_EQ(shape_of(grid.simulation.cloth).text(), "1 piece of 2 × 2 × 0 m, edges of 0.5 to 0.707 m");
  // Rounding errors in the flat direction of a rotated cloth do not count as a length.
  const Scene turned =
      folder.load("[cloth]\nmesh = { grid = [4, 4] }\nstiffness = 7\n[cloth.transform]\nrotate = [90, 0, 0]\n");
  EXPECT_EQ(shape_of(turned.simulation.cloth).text(), "1 piece of 2 × 0 × 2 m, edges of 0.5 to 0.707 m");
}

TEST(SceneMesh, EveryOtherFormIsAnError) {
  const SceneFolder folder;
  const auto problem = [&](const std::string& mesh) {
    return folder.problems("[cloth]\nmesh = " + mesh + "\nstiffness = 1\n");
  };
  EXPECT_EQ(problem("20"),
            "scene.toml:2:8: mesh: expected the name of a file, { file = …, prim = … } or { grid = [columns, rows] }, "
            "found a whole number");
  EXPECT_EQ(problem("{}"), "scene.toml:2:8: mesh: missing key 'grid', 'disc', 'strip', 'tube' or 'file'");
  EXPECT_EQ(problem("{ file = \"a.obj\", grid = [2, 2] }"),
            "scene.toml:2:26: mesh: unknown key 'grid'; the keys are 'file', 'prim', 'up'");
  EXPECT_EQ(problem("{ prim = \"/a\" }"), "scene.toml:2:8: mesh: missing key 'file'");
  EXPECT_EQ(problem("{ file = \"a.obj\", up = \"x\" }"), "scene.toml:2:31: mesh.up: expected 'y' or 'z', found 'x'");
  EXPECT_EQ(problem("{ gird = [2, 2] }"), "scene.toml:2:10: mesh: unknown key 'gird'; did you mean 'grid'?");
  EXPECT_EQ(problem("{ grid = 20 }"),
            "scene.toml:2:17: mesh.grid: expected an array of 2 whole numbers, found a whole number");
  EXPECT_EQ(problem("{ grid = [2, -1] }"), "scene.toml:2:21: mesh.grid[1] must be at least 1, found -1");
}

TEST(SceneMesh, AGridHasAPatternAndASize) {
  const SceneFolder folder;
  const auto grid = [&](const std::string& keys) {
    return folder.load("[cloth]\nmesh = { grid = [4, 2]" + keys + " }\nstiffness = 7\n").simulation.cloth;
  };
  const Cloth crossed = grid(", pattern = \"x\", size = [1.5, 1]");
  EXPECT_EQ(crossed.vertex_count(), 5 * 3 + 4 * 2);
  EXPECT_EQ(crossed.rest.colwise().maxCoeff(), Eigen::RowVector3d(0.75, 0.5, 0));
  EXPECT_EQ(crossed.rest.colwise().minCoeff(), Eigen::RowVector3d(-0.75, -0.5, 0));
  EXPECT_EQ(grid(", pattern = \"diagonal\"").rest, grid("").rest);
  EXPECT_EQ(grid(", pattern = \"alternating\"").triangles[2], (Triangle{1, 2, 7}));
  EXPECT_NEAR(grid(", pattern = \"equilateral\"").rest.col(1).maxCoeff(), std::sqrt(3.0) / 4, 1e-15);
}

TEST(SceneMesh, AGridOfAnotherPatternOrWithoutASizeIsAnError) {
  const SceneFolder folder;
  const auto problem = [&](const std::string& keys) {
    return folder.problems("[cloth]\nmesh = { grid = [4, 2], " + keys + " }\nstiffness = 1\n");
  };
  EXPECT_EQ(problem("pattern = \"alternate\""),
            "scene.toml:2:35: mesh.pattern: unknown pattern 'alternate'; did you mean 'alternating'?");
  EXPECT_EQ(problem("pattern = 1"), "scene.toml:2:35: mesh.pattern: expected a string, found a whole number");
  EXPECT_EQ(problem("size = [1, 0]"), "scene.toml:2:36: mesh.size[1] must be above 0, found 0");
  EXPECT_EQ(problem("size = 2"), "scene.toml:2:32: mesh.size: expected an array of 2 numbers, found a whole number");
}

TEST(SceneMesh, AHugeGridIsRefusedBeforeItIsMade) {
  const SceneFolder folder;
  const auto problem = [&](const std::string& cells) {
    return folder.problems("[cloth]\nmesh = { grid = " + cells + " }\nstiffness = 1\n");
  };
  EXPECT_EQ(problem("[2000, 2001]"), "scene.toml:2:17: mesh.grid: a grid has at most 4000000 cells, found 2000×2001");
  EXPECT_EQ(problem("[2147483647, 2147483647]"),
            "scene.toml:2:17: mesh.grid: a grid has at most 4000000 cells, found 2147483647×2147483647");
  EXPECT_EQ(problem("[1, 9223372036854775807]"),
            "scene.toml:2:21: mesh.grid[1] must be at least 1 and at most 2147483647, found 9223372036854775807");
}

TEST(ScenePins, AreVerticesCornersAndBoxesInAnyMixture) {
  const SceneFolder folder;
  EXPECT_EQ(pins(folder, "[]"), (std::vector<int>{}));
  EXPECT_EQ(pins(folder, "[5, 0, 5]"), (std::vector<int>{0, 5}));
  EXPECT_EQ(pins(folder, "[\"corner:x-y-\", \"corner:y-x+\", \"corner:x-y+\", \"corner:x+y+z-\"]"),
            (std::vector<int>{0, 2, 6, 8}));
  EXPECT_EQ(pins(folder, "[{ box = [[-1, 0, 0], [0, 1, 0]] }]"), (std::vector<int>{3, 4, 6, 7}));
  EXPECT_EQ(pins(folder, "[{ box = [[0, 1, 1], [-1, 0, -1]] }]"), (std::vector<int>{3, 4, 6, 7}))
      << "any two opposite corners";
  EXPECT_EQ(pins(folder, "[4, \"corner:x-y-\", { box = [[1, 1, 0], [1, 1, 0]] }]"), (std::vector<int>{0, 4, 8}));
}

TEST(ScenePins, OfSeveralFarthestVerticesTheFirstIsTheCorner) {
  const SceneFolder folder;
  EXPECT_EQ(pins(folder, "[\"corner:x+\"]"), (std::vector<int>{2}));
  EXPECT_EQ(pins(folder, "[\"corner:z-\"]"), (std::vector<int>{0}));
}

TEST(ScenePins, AreFoundInTheMeshAsItIsWritten) {
  const SceneFolder folder;
  const std::string moved = "transform = { rotate = [0, 0, 180], translate = [9, 9, 9], scale = 3 }\n";
  EXPECT_EQ(
      folder.load(cloth(moved + "pins = [\"corner:x-y-\", { box = [[1, 1, 0], [1, 1, 0]] }]")).simulation.cloth.pins,
      (std::vector<int>{0, 8}));
}

TEST(ScenePins, EveryWrongOneIsReported) {
  const SceneFolder folder;
  EXPECT_EQ(
      folder.problems(cloth("pins = [9, -1, 1.0, true]")),
      "scene.toml:4:9: pins[0]: the mesh has the vertices 0 to 8, found 9\n"
      "scene.toml:4:12: pins[1]: the mesh has the vertices 0 to 8, found -1\n"
      "scene.toml:4:16: pins[2]: expected a vertex number, 'corner:x-y-', 'edge:x-', 'border' or { box = … }, found a "
      "number\n"
      "scene.toml:4:21: pins[3]: expected a vertex number, 'corner:x-y-', 'edge:x-', 'border' or { box = … }, found "
      "true "
      "or false");
  for (const std::string corner : {"", "corner", "corner:", "corner:x", "corner:x-y", "corner:x-x+", "corner:w-",
                                   "corner:x*", "corner:x-y-z-x-", "CORNER:x-", "corner: x-"}) {
    EXPECT_EQ(
        folder.problems(cloth("pins = [\"" + corner + "\"]")),
        "scene.toml:4:9: pins[0]: expected a corner like 'corner:x-y-', an edge like 'edge:x-' or 'border', found '" +
            corner + "'");
  }
  EXPECT_EQ(folder.problems(cloth("pins = \"corner:x-y-\"")),
            "scene.toml:4:8: pins: expected an array, found a string");
  EXPECT_EQ(folder.problems(cloth("pins = [{ box = [[2, 2, 2], [3, 3, 3]] }]")),
            "scene.toml:4:17: pins[0].box: no vertex of the mesh is in this box");
  EXPECT_EQ(folder.problems(cloth("pins = [{ box = [[2, 2, 2]] }]")),
            "scene.toml:4:17: pins[0].box: expected two corners, [[x, y, z], [x, y, z]], found an array of 1");
  EXPECT_EQ(folder.problems(cloth("pins = [{ box = [[2, 2], 3] }]")),
            "scene.toml:4:18: pins[0].box[0]: expected an array of 3 numbers, found one of 2\n"
            "scene.toml:4:26: pins[0].box[1]: expected an array of 3 numbers, found a whole number");
  EXPECT_EQ(folder.problems(cloth("pins = [{ bx = 1 }, {}]")),
            "scene.toml:4:11: pins[0]: unknown key 'bx'; did you mean 'box'?\n"
            "scene.toml:4:21: pins[1]: expected { box = … }");
}

TEST(SceneTransform, ScalesThenTurnsThenMoves) {
  const SceneFolder folder;
  // Vertex 2 is (1, -1, 0). Scaled (3, -2, 0); about x by 90° (3, 0, -2); about z by 90° (0, 3, -2).
  const Cloth c = folder
                      .load(cloth("[cloth.transform]\nscale = [3, 2, 1]\nrotate = [90, 0, 90]\n"
                                  "translate = [0.5, 0.25, 0]"))
                      .simulation.cloth;
  EXPECT_NEAR((c.positions.row(2) - Eigen::RowVector3d(0.5, 3.25, -2)).norm(), 0, 4 * tiny);
}

TEST(SceneTransform, WithoutARestShapeOnlyScalingChangesTheSprings) {
  const SceneFolder folder;
  const Cloth plain = folder.load(cloth("")).simulation.cloth;
  const Cloth moved =
      folder.load(cloth("transform = { rotate = [10, 20, 30], translate = [1, 2, 3] }")).simulation.cloth;
  const Cloth larger = folder.load(cloth("transform.scale = 3")).simulation.cloth;
  for (std::size_t s = 0; s < plain.springs.size(); ++s) {
    EXPECT_EQ(moved.springs[s].rest_length, plain.springs[s].rest_length);
    EXPECT_DOUBLE_EQ(larger.springs[s].rest_length, 3 * plain.springs[s].rest_length);
  }
}

TEST(SceneTransform, WithARestShapeScalingStretchesTheStart) {
  const SceneFolder folder;
  const Cloth plain = folder.load(cloth("")).simulation.cloth;
  const Cloth stretched =
      folder.load(cloth("rest = { grid = [2, 2] }\ntransform = { scale = [1.5, 1, 1] }")).simulation.cloth;
  EXPECT_EQ(stretched.positions.col(0), 1.5 * plain.positions.col(0));
  for (std::size_t s = 0; s < plain.springs.size(); ++s) {
    EXPECT_EQ(stretched.springs[s].rest_length, plain.springs[s].rest_length);
  }
}

TEST(SceneTransform, ScaleIsPositive) {
  const SceneFolder folder;
  EXPECT_EQ(folder.problems(cloth("transform.scale = 0")), "scene.toml:4:19: scale must be above 0, found 0");
  EXPECT_EQ(folder.problems(cloth("transform.scale = [1, -1, 1]")),
            "scene.toml:4:23: scale[1] must be above 0, found -1");
  EXPECT_EQ(folder.problems(cloth("transform.scale = \"2\"")),
            "scene.toml:4:19: scale: expected a number, found a string");
}

TEST(SceneRest, HasTheVerticesAndTrianglesOfTheMesh) {
  const SceneFolder folder;
  EXPECT_EQ(folder.problems(cloth("rest = { grid = [2, 3] }")),
            "scene.toml:4:8: rest: expected the vertices and triangles of mesh, but it has 12 vertices, mesh has 9");
  EXPECT_EQ(
      folder.problems("[cloth]\nmesh = { grid = [2, 1] }\nrest = { grid = [1, 2] }\nstiffness = 1\n"),
      "scene.toml:3:8: rest: expected the vertices and triangles of mesh, but its triangle 0 is (1, 2, 0), in mesh "
      "it is (1, 3, 0)");
  folder.write("one.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\n");
  EXPECT_EQ(folder.problems("[cloth]\nmesh = { grid = [1, 1] }\nrest = \"one.obj\"\nstiffness = 1\n"),
            "scene.toml:3:8: rest: expected the vertices and triangles of mesh, but it has 1 triangles, mesh has 2");
}

TEST(SceneVelocity, IsThatOfEveryVertexButThePins) {
  const SceneFolder folder;
  const Cloth c = folder.load(cloth("velocity = [1, 2, 3]\npins = [4]")).simulation.cloth;
  for (int i = 0; i < c.vertex_count(); ++i) {
    EXPECT_EQ(Eigen::Vector3d(c.velocities.row(i)), i == 4 ? Eigen::Vector3d(0, 0, 0) : Eigen::Vector3d(1, 2, 3));
  }
}

// Vertices of no triangle, as some programs export, neither fall nor take a share of the mass.
TEST(SceneMesh, HoldsVerticesOfNoTriangle) {
  const SceneFolder folder;
  folder.write("a.obj", "v 9 9 9\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 2 3 4\n");
  for (const auto& [keys, mass] : {std::pair("mass = 0.6", 0.6), std::pair("density = 0.4", 0.2)}) {
    const LoadedScene scene =
        folder.load(std::string("[time]\nstep = 0.01\n[cloth]\nmesh = \"a.obj\"\nstiffness = 9\n") + keys);
    const Cloth& cloth = scene.simulation.cloth;
    EXPECT_EQ(cloth.pins, (std::vector{0})) << keys;
    EXPECT_NEAR(cloth.masses.tail(3).sum(), mass, 1e-15) << keys;
    EXPECT_GT(cloth.masses[0], 0);
    ASSERT_EQ(scene.source.warnings.size(), 1U);
    EXPECT_NE(scene.source.warnings[0].find("1 of its 4 vertices belongs to no triangle: they stay in place"),
              std::string::npos);
  }
}

TEST(SceneMass, IsSharedIntoPositiveParts) {
  const SceneFolder folder;
  EXPECT_EQ(folder.problems(cloth("mass = 5e-324")),
            "scene.toml:4:8: mass: too small to be shared by so many vertices");
}

}  // namespace
}  // namespace drape
