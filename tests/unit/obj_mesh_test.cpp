#include "scene/mesh/source.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <string>

#include "scene/mesh_value.hpp"
#include "tests/support/usage_error.hpp"

namespace drape {
namespace {

using test::usage_error;

Mesh parse(const std::string& text) { return read_obj_mesh(SourceText("cloth.obj", text)); }

std::string error_of(const std::string& text) {
  return usage_error([&] { parse(text); });
}

const std::string three_corners = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

TEST(ObjReader, MergesObjectsAndKeepsEveryVertexInItsOrder) {
  const Mesh mesh = read_mesh(DRAPE_SOURCE_DIR "/tests/data/polygons.obj");
  ASSERT_EQ(mesh.positions.rows(), 12);
  EXPECT_EQ(mesh.positions.row(3), Eigen::RowVector3d(0.5, 2, 0));
  EXPECT_EQ(mesh.positions.row(5), Eigen::RowVector3d(7, 7, 7)) << "which no face uses";
  EXPECT_EQ(mesh.positions.row(11), Eigen::RowVector3d(0, 2, 1));
}

TEST(ObjReader, TriangulatesConvexAndConcaveFaces) {
  const Mesh mesh = read_mesh(DRAPE_SOURCE_DIR "/tests/data/polygons.obj");
  ASSERT_EQ(mesh.triangles.size(), 3U + 4U);
  EXPECT_EQ(mesh.triangles[0], (Triangle{0, 1, 2}));
  EXPECT_EQ(mesh.triangles[2], (Triangle{0, 3, 4}));
  double area = 0;
  for (std::size_t t = 3; t < mesh.triangles.size(); ++t) {
    const auto& [i, j, k] = mesh.triangles[t];
    EXPECT_GE(std::min({i, j, k}), 6) << "the L has the vertices 6 to 11";
    const Eigen::RowVector3d a = mesh.positions.row(i), b = mesh.positions.row(j), c = mesh.positions.row(k);
    const double twice = (b - a).cross(c - a).z();
    EXPECT_GT(twice, 0);
    area += twice / 2;
  }
  EXPECT_DOUBLE_EQ(area, 3);
}

TEST(ObjReader, GivesEachCornerItsTextureCoordinates) {
  const Mesh mesh = read_mesh(DRAPE_SOURCE_DIR "/tests/data/polygons.obj");
  ASSERT_EQ(mesh.uvs.size(), 3 * mesh.triangles.size());
  using Uv = std::array<float, 2>;
  EXPECT_EQ(mesh.uvs[1], (Uv{1, 0}));
  EXPECT_EQ(mesh.uvs[7], (Uv{0.5, 1})) << "corner 1 of the triangle 0, 3, 4";
  EXPECT_EQ(mesh.uvs[8], (Uv{0, 0})) << "whose line gives only u";
  EXPECT_EQ(mesh.uvs[9], (Uv{0, 0})) << "of a face without";
  EXPECT_TRUE(parse(three_corners + "f 1 2 3\n").uvs.empty());
}

TEST(ObjReader, ReadsCoordinatesToTheLastBit) {
  const Mesh mesh = parse("v 0.1 0.3333333333333333 1e-7\nv 123456.789 -2.5E+3 .7\nv 0 0 0\nf 1 2 3\n");
  EXPECT_EQ(mesh.positions.row(0), Eigen::RowVector3d(0.1, 0.3333333333333333, 1e-7));
  EXPECT_EQ(mesh.positions.row(1), Eigen::RowVector3d(123456.789, -2500, 0.7));
}

TEST(ObjReader, TakesAnyLineEnding) {
  const Mesh reference = parse(three_corners + "f 1 2 3");
  for (const std::string ending : {"\r\n", "\r"}) {
    std::string text;
    for (const char c : three_corners + "f 1 2 3\n") text += c == '\n' ? ending : std::string(1, c);
    EXPECT_EQ(parse(text).positions, reference.positions);
    EXPECT_EQ(parse(text).triangles, reference.triangles);
  }
}

// Output of sewing programs: quads and pentagons, negative indices, unknown lines, and a seam with both sides present.
TEST(ObjReader, ReadsAGarmentOfOtherTools) {
  const Mesh mesh = parse(
      "v 0 0 0\r\nv 1 0 0\r\nv 1 1 0\r\nv 0 1 0\r\nvt 0 0\r\nvt 1 0\r\nvt 1 1\r\nvt 0 1\r\nf -4/-4 -3/-3 -2/-2 "
      "-1/-1\r\nv 1 0 0\r\nv 2 0 0\r\nv 2.5 0.5 0\r\nv 2 1 0\r\nv 1 1 0\r\nvv 2 5\r\nvv 3 9\r\ns off\r\nf 5 6 7 8 "
      "9\r\n");
  EXPECT_EQ(mesh.positions.rows(), 9);
  EXPECT_EQ(mesh.triangles.size(), 2U + 3U);
  EXPECT_EQ(mesh.triangles.front(), (Triangle{0, 1, 2}));
  EXPECT_EQ(mesh.uvs.size(), 3 * mesh.triangles.size());
}

TEST(ObjReader, MayNameVerticesFurtherDownTheFile) {
  EXPECT_EQ(parse("f 1 2 3\n" + three_corners).triangles[0], (Triangle{0, 1, 2}));
}

TEST(ObjReader, NamesTheLineOfACornerBeyondTheVertices) {
  const std::string file = DRAPE_SOURCE_DIR "/tests/data/broken_index.obj";
  EXPECT_EQ(usage_error([&] { read_mesh(file); }), file + ":6:7: the face names number 4, but the file has 3 vertices");
  EXPECT_EQ(error_of(three_corners + "f 1/1 2/1 3/1\n"),
            "cloth.obj:4:3: the face names number 1, but the file has 0 texture coordinates");
  EXPECT_EQ(error_of(three_corners + "f 1 -4 3\n"),
            "cloth.obj:4:5: -4 counts back beyond the first of the 3 vertices so far");
  EXPECT_EQ(error_of("v 0 0 0\nf -1 -2 1\n" + three_corners),
            "cloth.obj:2:6: -2 counts back beyond the first of the 1 vertices so far");
  EXPECT_EQ(error_of(three_corners + "f 1 2 0\n"), "cloth.obj:4:7: vertices are numbered from 1, found 0");
}

TEST(ObjReader, NamesTheLineOfAnUnreadableCorner) {
  for (const std::string corner :
       {"x", "2x", "1/", "1//", "1/2/", "/1", "1/2/3/4", "1.5", "99999999999", "1/x", "--1"}) {
    EXPECT_EQ(error_of(three_corners + "f 1 " + corner + " 3\n"),
              "cloth.obj:4:5: expected a corner such as 3, 3/1, 3/1/2 or 3//2, found '" + corner + "'");
  }
}

TEST(ObjReader, NamesTheLineOfAFaceWithTooFewCorners) {
  EXPECT_EQ(error_of(three_corners + "\n f 1 2 # 3\n"), "cloth.obj:5:2: a face needs at least 3 corners, found 2");
  EXPECT_EQ(error_of(three_corners + "f\n"), "cloth.obj:4:1: expected numbers after 'f'");
}

TEST(ObjReader, NamesTheLineOfABadCoordinate) {
  for (const std::string number : {"x", "1,5", "nan", "inf", "-inf", "1e999", "0x10", "1.2.3", "+-1"}) {
    EXPECT_EQ(error_of("v 0 0 0\nv 1 " + number + " 0\n"),
              "cloth.obj:2:5: expected a finite number, found '" + number + "'");
  }
  EXPECT_EQ(error_of("v 0 0 0\r\n\tv 1 2\r\n"), "cloth.obj:2:2: expected 'v x y z', found 2 numbers");
  EXPECT_EQ(error_of("v 0 0 0\nv\n"), "cloth.obj:2:1: expected numbers after 'v'");
  EXPECT_EQ(error_of("vt nan 0\n"), "cloth.obj:1:4: expected a finite number, found 'nan'");
}

TEST(ObjReader, SaysThatThereIsNoFaceOrNoVertex) {
  EXPECT_EQ(error_of(three_corners), "cloth.obj: there is no face ('f 1 2 3') in the file");
  EXPECT_EQ(error_of("\x7f"
                     "ELF\x01\x02 binary\n"),
            "cloth.obj: there is no vertex ('v x y z') in the file");
}

// A truncated file is valid or gets a message; reading never crashes or hangs.
TEST(ObjReader, SurvivesAFileCutAnywhere) {
  const std::string text(SourceText::read(DRAPE_SOURCE_DIR "/tests/data/polygons.obj").text());
  for (std::size_t size = 0; size < text.size(); ++size) {
    const std::string message = error_of(text.substr(0, size));
    EXPECT_TRUE(message == "(no error)" || message.starts_with("cloth.obj:")) << size << ": " << message;
  }
}

}  // namespace
}  // namespace drape
