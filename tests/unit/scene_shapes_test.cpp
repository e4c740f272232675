#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "drape/sim/body_shape.hpp"
#include "drape/sim/cloth.hpp"
#include "scene/mesh_value.hpp"
#include "tests/support/cloths.hpp"
#include "tests/support/scene_folder.hpp"

// Shapes defined by a few numbers: their geometry, their keys in scenes, and errors.

namespace drape::scene_shapes {
namespace {

using test::SceneFolder;
constexpr double pi = std::numbers::pi;

Eigen::Vector3d corner(const Mesh& mesh, const Triangle& t, std::size_t c) { return mesh.positions.row(t[c]); }

double area(const Mesh& mesh) {
  double sum = 0;
  for (const Triangle& t : mesh.triangles) {
    sum += (corner(mesh, t, 1) - corner(mesh, t, 0)).cross(corner(mesh, t, 2) - corner(mesh, t, 0)).norm() / 2;
  }
  return sum;
}

/// Returns the volume by Gauss's theorem; positive if triangles are counterclockwise seen from outside.
double volume(const Mesh& mesh) {
  double sum = 0;
  for (const Triangle& t : mesh.triangles) {
    sum += corner(mesh, t, 0).dot(corner(mesh, t, 1).cross(corner(mesh, t, 2))) / 6;
  }
  return sum;
}

/// Returns vertices − edges + triangles: 2 for a closed surface, 1 for a disc, 0 for a tube.
Eigen::Index euler(const Mesh& mesh) {
  return mesh.positions.rows() - static_cast<Eigen::Index>(unique_edges(mesh.triangles).size()) +
         static_cast<Eigen::Index>(mesh.triangles.size());
}

/// Returns true if every edge is passed once in each direction.
bool closed(const Mesh& mesh) {
  std::map<std::pair<int, int>, int> passes;
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t c = 0; c < 3; ++c) ++passes[{t[c], t[(c + 1) % 3]}];
  }
  for (const auto& [edge, count] : passes) {
    const auto back = passes.find({edge.second, edge.first});
    if (count != 1 || back == passes.end() || back->second != 1) return false;
  }
  return true;
}

ParametricMesh sheet(ParametricMesh::Kind kind) { return {.kind = kind}; }

TEST(SheetShapes, ADiscIsRoundAndFacesUp) {
  ParametricMesh shape = sheet(ParametricMesh::Kind::disc);
  shape.radius = 0.5;
  for (const int rings : {1, 2, 5, 24}) {
    shape.rings = rings;
    const Mesh mesh = make_mesh_shape(shape);
    EXPECT_EQ(mesh.positions.rows(), 1 + 3 * rings * (rings + 1));
    EXPECT_EQ(mesh.triangles.size(), static_cast<std::size_t>(6 * rings * rings));
    EXPECT_EQ(euler(mesh), 1);
    const int sides = 6 * rings;  // of the polygon at its border
    EXPECT_NEAR(area(mesh), sides / 2.0 * 0.25 * std::sin(2 * pi / sides), 1e-12) << rings;
    EXPECT_NEAR(mesh.positions.rowwise().norm().maxCoeff(), 0.5, 1e-15);
    for (const Triangle& t : mesh.triangles) {
      EXPECT_GT((corner(mesh, t, 1) - corner(mesh, t, 0)).cross(corner(mesh, t, 2) - corner(mesh, t, 0)).z(), 0);
    }
    EXPECT_EQ(mesh.uvs.size(), 3 * mesh.triangles.size());
  }
}

TEST(SheetShapes, AStripHasSquareCells) {
  ParametricMesh shape = sheet(ParametricMesh::Kind::strip);
  shape.length = 3, shape.width = 0.3, shape.across = 3;
  const Mesh mesh = make_mesh_shape(shape);
  EXPECT_EQ(mesh.triangles.size(), 2U * 30 * 3);
  EXPECT_NEAR(area(mesh), 0.9, 1e-12);
  EXPECT_EQ(mesh.positions.colwise().maxCoeff(), Eigen::RowVector3d(1.5, 0.15, 0));
}

TEST(SheetShapes, ATubeIsOpenAtBothEnds) {
  ParametricMesh shape = sheet(ParametricMesh::Kind::tube);
  shape.radius = 0.2, shape.length = 1, shape.around = 64;
  const Mesh tube = make_mesh_shape(shape);
  EXPECT_EQ(euler(tube), 0);
  EXPECT_NEAR(area(tube), 64 * 2 * 0.2 * std::sin(pi / 64), 1e-12);
  EXPECT_GT(volume(tube), 0) << "it faces outwards";
  shape.hem = 0.5;
  const Mesh skirt = make_mesh_shape(shape);
  const double slant = std::hypot(1, 0.3);
  EXPECT_NEAR(area(skirt), pi * 0.7 * slant, 2e-3 * area(skirt));
  EXPECT_NEAR(skirt.positions.leftCols(2).rowwise().norm().maxCoeff(), 0.5, 1e-12);
  EXPECT_EQ(skirt.uvs.size(), 3 * skirt.triangles.size());
}

TEST(SheetShapes, AreMeshesOfScenes) {
  const SceneFolder folder;
  const auto cloth = [&](const std::string& mesh, const std::string& more = "") {
    return folder.load("[cloth]\nmesh = " + mesh + "\nstiffness = 10\n" + more).simulation.cloth;
  };
  EXPECT_EQ(cloth("{ disc = { radius = 0.5, rings = 3 } }").vertex_count(), 37);
  EXPECT_EQ(cloth("{ strip = { length = 1, width = 0.1, across = 1 } }").vertex_count(), 22);
  EXPECT_EQ(cloth("{ tube = { around = 8, length = 1, radius = 0.2 } }", "pins = [\"edge:z+\"]").pins.size(), 8U);
  EXPECT_EQ(cloth("{ disc = {} }").vertex_count(), 817);
  const auto problem = [&](const std::string& mesh) {
    return folder.problems("[cloth]\nmesh = " + mesh + "\nstiffness = 10\n");
  };
  EXPECT_EQ(problem("{ disc = { radius = 0 } }"), "scene.toml:2:28: radius must be above 0, found 0");
  EXPECT_EQ(problem("{ disc = { ring = 3 } }"),
            "scene.toml:2:19: unknown key 'ring' in [mesh.disc]; did you mean 'rings'?");
  EXPECT_EQ(problem("{ disc = 3 }"), "scene.toml:2:17: expected a table [mesh.disc], found a whole number");
  EXPECT_EQ(problem("{ disc = {}, grid = [2, 2] }"), "scene.toml:2:21: mesh: 'disc' is given, so 'grid' cannot be");
  EXPECT_EQ(problem("{ dics = {} }"), "scene.toml:2:10: mesh: unknown key 'dics'; did you mean 'disc'?");
  EXPECT_EQ(problem("{ strip = { length = 1e9, width = 0.1 } }"),
            "scene.toml:2:8: mesh.strip: a mesh has at most 8 million triangles");
}

TEST(BodyShapes, AreClosedWithTheirVolume) {
  using Kind = BodyShape::Kind;
  const double r = 0.3, h = 1.4, section = 64 / 2.0 * std::sin(2 * pi / 64);  // of a polygon in a circle of 1 m
  const BodyShape cylinder{.kind = Kind::cylinder, .radius = r, .height = h};
  const BodyShape cone{.kind = Kind::cone, .radius = r, .height = h};
  const BodyShape frustum{.kind = Kind::cone, .radius = r, .height = h, .top = 0.1};
  const BodyShape capsule{.kind = Kind::capsule, .radius = r, .height = h};
  const BodyShape sphere{.kind = Kind::sphere, .radius = r};
  for (const BodyShape& shape : {cylinder, cone, frustum, capsule, sphere}) {
    const Mesh mesh = make_body_shape(shape);
    EXPECT_TRUE(closed(mesh));
    EXPECT_EQ(euler(mesh), 2);
    const double height = shape.kind == Kind::sphere ? 2 * r : h;
    EXPECT_NEAR(mesh.positions.col(2).maxCoeff(), height / 2, 1e-12);
    EXPECT_NEAR(mesh.positions.col(2).minCoeff(), -height / 2, 1e-12);
  }
  EXPECT_NEAR(volume(make_body_shape(cylinder)), section * r * r * h, 1e-12);
  EXPECT_NEAR(volume(make_body_shape(cone)), section * r * r * h / 3, 1e-12);
  EXPECT_NEAR(volume(make_body_shape(frustum)), section * h / 3 * (r * r + r * 0.1 + 0.01), 1e-12);
  const double ball = 4 * pi / 3 * r * r * r;
  EXPECT_NEAR(volume(make_body_shape(sphere)), ball, 0.01 * ball);
  const double rounded = ball + pi * r * r * (h - 2 * r);
  EXPECT_NEAR(volume(make_body_shape(capsule)), rounded, 0.01 * rounded);
  const Mesh plane = make_body_shape({.kind = Kind::plane, .width = 2, .depth = 3});
  EXPECT_NEAR(area(plane), 6, 1e-12);
}

TEST(BodyShapes, AreNamedInScenes) {
  const SceneFolder folder;
  const auto body = [](const std::string& line) { return test::with("effects.body", line); };
  for (const std::string line : {"cylinder = { radius = 0.2, height = 1 }", "capsule = { radius = 0.2, height = 1 }",
                                 "cone = { radius = 0.2, height = 1, top = 0.1 }", "plane = { width = 1, depth = 2 }",
                                 "sphere = { radius = 0.2 }", "sphere = { radius = 0.2, segments = 16 }"}) {
    EXPECT_EQ(folder.problems(body(line + "\ncenter = [0, 0, -2]")), "(no error)") << line;
  }
  EXPECT_EQ(folder.problems(body("")),
            "scene.toml:4:1: missing key 'box', 'file', 'cylinder', 'capsule', 'cone', "
            "'plane' or 'sphere' in [effects.body]");
  EXPECT_EQ(folder.problems(body("cylinder = { radius = 0.2 }")),
            "scene.toml:5:12: missing key 'height' in [cylinder]");
  EXPECT_EQ(folder.problems(body("sphere = { radius = -1 }")), "scene.toml:5:21: radius must be above 0, found -1");
  EXPECT_EQ(folder.problems(body("capsule = { radius = 1, height = 1 }")),
            "scene.toml:5:11: capsule: a capsule is at least as high as both of its caps, twice its radius");
  EXPECT_EQ(folder.problems(body("sphere = 3")), "scene.toml:5:10: expected a table [sphere], found a whole number");
  EXPECT_EQ(folder.problems(body("box = [1, 1, 1]\nsphere = { radius = 1 }")),
            "scene.toml:6:10: sphere: give only one of 'box' and 'sphere': each is the body's shape");
  EXPECT_NE(folder.problems(body("cone = { radius = 1, height = 1 }\nsphere = { radius = 1 }"))
                .find("each is the body's shape"),
            std::string::npos);
}

/// Two scenes that differ only in a body's shape are different motions.
TEST(BodyShapes, BelongToTheMotion) {
  const SceneFolder folder;
  const auto tables = [&](const std::string& radius) {
    std::string text;
    for (const SceneValue& value :
         folder.load(test::with("effects.body", "sphere = { radius = " + radius + " }\ncenter = [0, 0, -2]"))
             .source.tables) {
      text += value.key + "=" + value.text + "\n";
    }
    return text;
  };
  EXPECT_NE(tables("0.2"), tables("0.3"));
  EXPECT_EQ(tables("0.2"), tables("0.20"));
}

TEST(Ground, AloneLiesAtTheOrigin) {
  const SceneFolder folder;
  const Scene scene = folder.load(test::least_scene + "[effects.ground]\n");
  ASSERT_EQ(scene.simulation.effects.size(), 1U);
}

TEST(ScenePins, AnEdgeIsEveryVertexAsFarAsTheFarthest) {
  const SceneFolder folder;
  const auto pins = [&](const std::string& text, const std::string& mesh = "{ grid = [2, 2] }") {
    return folder.load("[cloth]\nmesh = " + mesh + "\nstiffness = 10\npins = " + text + "\n").simulation.cloth.pins;
  };
  EXPECT_EQ(pins("[\"edge:x-\"]"), (std::vector<int>{0, 3, 6}));
  EXPECT_EQ(pins("[\"edge:y+\"]"), (std::vector<int>{6, 7, 8}));
  EXPECT_EQ(pins("[\"edge:x+\", \"edge:y-\"]"), (std::vector<int>{0, 1, 2, 5, 8}));
  EXPECT_EQ(pins("[\"edge:x+y+\"]"), (std::vector<int>{8}));
  EXPECT_EQ(pins("[\"border\"]"), (std::vector<int>{0, 1, 2, 3, 5, 6, 7, 8}));
  EXPECT_EQ(pins("[\"border\"]", "{ disc = { rings = 2 } }").size(), 12U);
  EXPECT_EQ(pins("[\"border\"]"), pins("[{ border = \"all\" }]"));
  EXPECT_EQ(folder.problems(test::with("cloth", "pins = [\"edge:w\"]")),
            "scene.toml:5:9: pins[0]: expected a corner like 'corner:x-y-', an edge like 'edge:x-' or 'border', found "
            "'edge:w'");
}

/// For a plate of thickness t, rigidity and modulus are related by D = E·t²/12/(1 − ν²).
TEST(Fabrics, PaperIsAPlate) {
  const Fabric& paper = test::fabric("paper");
  const double thickness = 0.11e-3, poisson = 0.3;
  ASSERT_TRUE(paper.rigidity.isotropic() && paper.modulus.isotropic());
  EXPECT_NEAR(paper.rigidity.warp, paper.modulus.warp * thickness * thickness / 12 / (1 - poisson * poisson),
              0.01 * paper.rigidity.warp);
  for (const char* name : {"cotton", "silk", "wool", "canvas"}) {
    EXPECT_NO_THROW(test::fabric(name)) << name;
  }
}

}  // namespace
}  // namespace drape::scene_shapes
