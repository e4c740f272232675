#include "scene/usd/mesh.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "scene/mesh_value.hpp"
#include "tests/support/usage_error.hpp"
#include "tests/unit/usd_texts.hpp"

namespace drape {
namespace {

using test::usage_error;
using test::usd_error;
using test::usd_header;
using test::usd_mesh;
using test::usd_triangle;
using Uv = std::array<float, 2>;

const std::string test_data = DRAPE_SOURCE_DIR "/tests/data/";

/// Returns the message for a mesh with these lines from line 5 on.
std::string mesh_error(const std::string& lines) {
  return usd_error(usd_header + "def Mesh \"m\" {\n" + lines + "\n}\n");
}

// The quad lies at y = 2 units above the origin in a y-up file of half-metre units: at z = 1 m, and its −z is our +y.
TEST(UsdReader, PlacesAYUpMeshInMetresWithZUp) {
  const Mesh mesh = read_mesh(test_data + "house_y_up.usda");
  Vertices expected(5, 3);
  expected << 0, 0, 1, 0.5, 0, 1, 0.5, 0.5, 1, 0, 0.5, 1, 0.25, 1, 1;
  EXPECT_EQ(mesh.positions, expected);
}

TEST(UsdReader, TriangulatesAQuadAndKeepsTheTextureOfItsCorners) {
  const Mesh mesh = read_mesh(test_data + "house_y_up.usda");
  EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}, {3, 2, 4}}));
  EXPECT_EQ(mesh.uvs, (std::vector<Uv>{{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}, {0, 1}, {1, 1}, {0.5, 2}}));
}

TEST(UsdReader, FlipsALeftHandedMeshWithItsTexture) {
  const Mesh mesh = read_mesh(test_data + "vertex_uvs.usda");
  ASSERT_EQ(mesh.triangles.size(), 2U);
  EXPECT_EQ(mesh.triangles[0], (Triangle{0, 2, 1}));
  EXPECT_EQ(mesh.triangles[1], (Triangle{2, 3, 1}));
  for (std::size_t corner = 0; corner < 6; ++corner) {
    const auto position = mesh.positions.row(mesh.triangles[corner / 3][corner % 3]);
    EXPECT_EQ(mesh.uvs[corner], (Uv{static_cast<float>(position[0]), static_cast<float>(position[1])}));
  }
}

TEST(UsdReader, KeepsTheFrontOfAMeshThatItsTransformMirrors) {
  const Mesh mesh =
      usd_mesh(usd_header + "def Mesh \"m\" {\n" + usd_triangle +
               "float3 xformOp:scale = (-1, 1, 1)\nuniform token[] xformOpOrder = [\"xformOp:scale\"]\n}\n");
  EXPECT_EQ(mesh.positions.row(1), Eigen::RowVector3d(-1, 0, 0));
  EXPECT_EQ(mesh.triangles[0], (Triangle{0, 2, 1})) << "counterclockwise seen from +z, as before";
}

TEST(UsdReader, ReadsIndexedTextureCoordinates) {
  const Mesh mesh = read_mesh(test_data + "indexed_uvs.usda");
  EXPECT_EQ(mesh.uvs, (std::vector<Uv>{{0.5, 0.125}, {0.25, 0.75}, {0.5, 0.125}}));
}

TEST(UsdReader, RefusesSeveralMeshesAndListsThem) {
  const std::string quad = "def Mesh \"b\" {\npoint3f[] points = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]\n}\n";
  const std::string both = usd_header + "def Xform \"a\" {\ndef Mesh \"m\" {\n" + usd_triangle + "}\n}\n" + quad;
  EXPECT_EQ(usd_error(both),
            "cloth.usda: expected one Mesh in the file, found 2: /a/m (3 vertices, 1 triangles, 1 × 1 × 0 m), /b (4 "
            "vertices, 0 triangles, 1 × 1 × 0 m); choose one by its name: { file = …, prim = \"/a/m\" }");
  std::string many = usd_header;
  for (int i = 0; i < 1000; ++i) many += "def Mesh \"m" + std::to_string(i) + "\" {}\n";
  const std::string message = usd_error(many);
  EXPECT_NE(message.find("/m19 (0 vertices, 0 triangles) and 980 more"), std::string::npos) << message;
}

TEST(UsdReader, TakesTheUnitAndUpAxisOfTheSchemaWhereTheFileIsSilent) {
  const Mesh mesh = usd_mesh("#usda 1.0\ndef Mesh \"m\" {\n" + usd_triangle + "}\n");
  EXPECT_EQ(mesh.positions.row(1), Eigen::RowVector3d(0.01, 0, 0));
  EXPECT_EQ(mesh.positions.row(2), Eigen::RowVector3d(0, 0, 0.01));
}

TEST(UsdReader, TakesTheFirstSampleOfMovingPoints) {
  const Mesh mesh = usd_mesh(usd_header +
                             "def Mesh \"m\" {\nint[] faceVertexCounts = [3]\nint[] faceVertexIndices = [0, 1, 2]\n"
                             "point3f[] points.timeSamples = { 5: [(9, 9, 9)], 1: None,\n"
                             "2: [(0, 0, 7), (1, 0, 7), (0, 1, 7)], 3: [] }\n}\n");
  ASSERT_EQ(mesh.positions.rows(), 3);
  EXPECT_EQ(mesh.positions(0, 2), 7);
}

TEST(UsdReader, SpreadsTextureCoordinatesByTheirInterpolation) {
  const auto uvs = [](const std::string& list, const std::string& interpolation) {
    return usd_mesh(usd_header + "def Mesh \"m\" {\n" + usd_triangle + "texCoord2f[] primvars:st = " + list +
                    " ( interpolation = \"" + interpolation + "\" )\n}\n")
        .uvs;
  };
  EXPECT_EQ(uvs("[(1, 2)]", "constant"), (std::vector<Uv>(3, {1, 2})));
  EXPECT_EQ(uvs("[(1, 2)]", "uniform"), (std::vector<Uv>(3, {1, 2})));
  EXPECT_EQ(uvs("[(1, 2), (3, 4), (5, 6)]", "varying"), (std::vector<Uv>{{1, 2}, {3, 4}, {5, 6}}));
}

TEST(UsdReader, NamesTheColumnOfWhatIsNotANumber) {
  const std::string file = test_data + "broken_array.usda";
  EXPECT_EQ(usage_error([&] { read_mesh(file); }),
            file + ":9:35: expected a finite number in the array faceVertexIndices, found 'x'");
}

TEST(UsdReader, NamesTheLineOfAMissingComma) {
  EXPECT_EQ(mesh_error("int[] faceVertexIndices = [0, 1 x, 2]"),
            "cloth.usda:5:33: expected ',' or ']' in the array faceVertexIndices, found 'x'");
  EXPECT_EQ(mesh_error("point3f[] points = [(0, 0, 0), (1, 0), (0, 0, 0)]"),
            "cloth.usda:5:37: expected ',' and 3 numbers in a tuple of the array points, found ')'");
  EXPECT_EQ(mesh_error("point3f[] points = [(0, 0, 0, 0)]"),
            "cloth.usda:5:29: expected ')' after the 3 numbers of a tuple of the array points, found ','");
}

TEST(UsdReader, NamesTheLineOfAMissingBracket) {
  EXPECT_EQ(mesh_error("float[] unknown = [1, 2\nint[] faceVertexCounts = [3]"),
            "cloth.usda:7:1: expected ']' for the '[' of line 5, found '}'");
  EXPECT_EQ(usd_error(usd_header + "def Mesh \"m\"\n{\n" + usd_triangle),
            "cloth.usda:9:1: expected '}' to close the prim 'm' of line 4, found the end of the file");
  EXPECT_EQ(usd_error(usd_header + "def Mesh \"m\" { }\n}\n"),
            "cloth.usda:5:1: expected 'def', 'over' or 'class', found '}'");
}

TEST(UsdReader, RefusesCoordinatesThatAreNotFinite) {
  for (const std::string number : {"nan", "inf", "-inf", "1e999", "1.2.3"}) {
    EXPECT_EQ(mesh_error("point3f[] points = [(0, 0, " + number + ")]"),
              "cloth.usda:5:28: expected a finite number in the array points, found '" + number + "'");
  }
  EXPECT_EQ(usd_error("#usda 1.0\n( metersPerUnit = 1e300 )\ndef Mesh \"m\" {\nint[] faceVertexCounts = []\n"
                      "int[] faceVertexIndices = []\npoint3f[] points = [(0, 0, 0), (1e300, 0, 0)]\n}\n"),
            "cloth.usda:6:33: this point overflows in metres");
}

TEST(UsdReader, NamesTheIndexThatIsOutOfRange) {
  const std::string rest = "point3f[] points = [(0, 0, 0), (1, 0, 0), (0, 1, 0)]\nint[] faceVertexCounts = [3]\n";
  EXPECT_EQ(mesh_error(rest + "int[] faceVertexIndices = [0, 1, 3]"),
            "cloth.usda:7:34: faceVertexIndices: expected a whole number from 0 to 2, found 3");
  EXPECT_EQ(mesh_error(rest + "int[] faceVertexIndices = [0,\n# a comment, 7\n -1, 2]"),
            "cloth.usda:9:2: faceVertexIndices: expected a whole number from 0 to 2, found -1");
  EXPECT_EQ(mesh_error(rest + "int[] faceVertexIndices = [0, 1.5, 2]"),
            "cloth.usda:7:31: faceVertexIndices: expected a whole number from 0 to 2, found 1.5");
}

TEST(UsdReader, NamesCountsThatDoNotFit) {
  const std::string points = "point3f[] points = [(0, 0, 0), (1, 0, 0), (0, 1, 0)]\n";
  EXPECT_EQ(mesh_error(points + "int[] faceVertexCounts = [3, 4]\nint[] faceVertexIndices = [0, 1, 2]"),
            "cloth.usda:6:26: the faceVertexCounts add up to 7, but there are 3 faceVertexIndices");
  EXPECT_NE(mesh_error(points + "int[] faceVertexCounts = [3, 2]\nint[] faceVertexIndices = [0, 1, 2, 0, 1]")
                .find("cloth.usda:6:30: faceVertexCounts: expected a whole number from 3"),
            std::string::npos);
  EXPECT_EQ(mesh_error(usd_triangle + "texCoord2f[] primvars:st = [(0, 0)] ( interpolation = \"faceVarying\" )"),
            "cloth.usda:8:1: primvars:st: expected 3 texture coordinates (interpolation faceVarying), found 1");
}

TEST(UsdReader, SaysWhatAMeshLacks) {
  EXPECT_EQ(mesh_error("int[] faceVertexCounts = []"), "cloth.usda:4:1: the Mesh 'm' has no points");
  EXPECT_EQ(mesh_error("point3f[] points = None"), "cloth.usda:4:1: the Mesh 'm' has no points");
  EXPECT_EQ(mesh_error("float points = 1"), "cloth.usda:5:1: points: expected an array of point3f, found float");
  EXPECT_EQ(usd_error(usd_header), "cloth.usda: there is no Mesh in the file");
  EXPECT_EQ(mesh_error("point3f[] points = []\nint[] faceVertexCounts = []\nint[] faceVertexIndices = []"),
            "cloth.usda: there is no face in the file");
}

TEST(UsdReader, ChecksTheFilesOwnStatements) {
  EXPECT_EQ(usd_error("v 0 0 0\n"), "cloth.usda:1:1: expected '#usda 1.0', found 'v 0 0 0'");
  EXPECT_EQ(usd_error("#usda 1.0\n(\n upAxis = \"X\"\n)\n"),
            "cloth.usda:3:11: upAxis: expected \"Y\" or \"Z\", found 'X'");
  EXPECT_EQ(usd_error("#usda 1.0\n(\n metersPerUnit = 0\n)\n"),
            "cloth.usda:3:18: expected a positive number for metersPerUnit, found '0'");
  EXPECT_EQ(usd_error("#usda 1.0\n\"\"\"\n\n"), "cloth.usda:2:1: this string is never closed by \"\"\"");
  EXPECT_EQ(usd_error("#usda 1.0\ndef \"a\n\" {}"), "cloth.usda:2:5: this string is never closed by \"");
  EXPECT_EQ(usd_error("#usda 1.0\n\x01"), "cloth.usda:2:1: unexpected character '\\x01'");
}

TEST(UsdReader, CountsColumnsInCharactersNotBytes) {
  EXPECT_EQ(usd_error("#usda 1.0\ndef \"düne\" !"), "cloth.usda:2:12: unexpected character '!'");
}

TEST(UsdReader, RefusesPrimsNestedTooDeep) {
  std::string text = usd_header;
  for (int i = 0; i < 100000; ++i) text += "def \"a\" {";
  EXPECT_EQ(usd_error(text), "cloth.usda:4:1801: prims nested deeper than 200");
  EXPECT_NE(usd_error(usd_header + "def Mesh \"m\" { float[] a = " + std::string(100000, '[')), "(no error)");
}

// A truncated file is valid or gets a message; reading never crashes or hangs.
TEST(UsdReader, SurvivesAFileCutAnywhere) {
  for (const char* name : {"house_y_up.usda", "vertex_uvs.usda", "indexed_uvs.usda"}) {
    const std::string text(SourceText::read(test_data + name).text());
    const std::size_t last = text.find_last_not_of(" \n");
    for (std::size_t size = 0; size <= last; ++size) {
      const std::string message = usd_error(text.substr(0, size));
      if (name == std::string("house_y_up.usda")) {
        EXPECT_TRUE(message.starts_with("cloth.usda:")) << size;
      }
    }
    EXPECT_EQ(usd_error(text.substr(0, last + 1)), "(no error)");
  }
}

// For any single damaged byte, reading ends with some result.
TEST(UsdReader, SurvivesAnyDamagedByte) {
  const std::string text(SourceText::read(test_data + "indexed_uvs.usda").text());
  for (std::size_t i = 0; i < text.size(); ++i) {
    for (const char damage : {'\0', '(', ']', '"', '9', '-', '\xff'}) {
      std::string damaged = text;
      damaged[i] = damage;
      const std::string message = usd_error(damaged);
      EXPECT_TRUE(message == "(no error)" || message.starts_with("cloth.usda:")) << message;
    }
  }
}

}  // namespace
}  // namespace drape
