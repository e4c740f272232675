#include "scene/mesh_value.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <filesystem>
#include <fstream>
#include <string>

#include "scene/mesh/source.hpp"
#include "tests/support/usage_error.hpp"

namespace drape {
namespace {

using test::usage_error;
using ::testing::TempDir;

std::string write(const std::string& name, const std::string& text) {
  std::string path = TempDir() + "drape_mesh_file_" + name;
  std::ofstream(path, std::ios::binary) << text;
  return path;
}

constexpr const char* usd_file = R"(#usda 1.0
(
    metersPerUnit = 1
    upAxis = "Z"
)
def Mesh "m"
{
    int[] faceVertexCounts = [3]
    int[] faceVertexIndices = [0, 1, 2]
    point3f[] points = [(0, 0, 0), (1, 0, 0), (0, 1, 0)]
}
)";

TEST(MeshFile, IsReadByItsEndingInAnyCase) {
  EXPECT_EQ(read_mesh(write("a.OBJ", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")).triangles.size(), 1U);
  EXPECT_EQ(read_mesh(write("a.usda", usd_file)).triangles.size(), 1U);
  EXPECT_EQ(read_mesh(write("a.Usd", usd_file)).triangles.size(), 1U);
}

TEST(MeshFile, NamesTheEndingsItKnows) {
  EXPECT_EQ(usage_error([] { read_mesh("cloth.fbx"); }),
            "cloth.fbx: expected a mesh in an .obj, .usda or .usd file, found '.fbx'");
  EXPECT_EQ(usage_error([] { read_mesh("cloth"); }),
            "cloth: expected a mesh in an .obj, .usda or .usd file, found a name without an ending");
}

TEST(MeshFile, SaysThatTheFileIsMissingOrAFolder) {
  EXPECT_EQ(usage_error([] { read_mesh("no/such.obj"); }), "no/such.obj: no such file");
  const std::string folder = TempDir() + "drape_folder.obj";
  std::filesystem::create_directories(folder);
  EXPECT_EQ(usage_error([&] { read_mesh(folder); }), folder + ": this is a folder, not a file");
}

TEST(MeshFile, MayBeginWithAByteOrderMark) {
  const std::string mark = "\xEF\xBB\xBF";
  const Mesh mesh = read_mesh(write("marked.obj", mark + "v 1 2 3\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"));
  ASSERT_EQ(mesh.positions.rows(), 3);
  EXPECT_EQ(mesh.positions.row(0), Eigen::RowVector3d(1, 2, 3));
  EXPECT_EQ(read_mesh(write("marked.usda", mark + usd_file)).positions.rows(), 3);
  const std::string wide = write("wide.obj", std::string("\xFE\xFF\0v\0 ", 6));
  EXPECT_EQ(usage_error([&] { read_mesh(wide); }), wide + ": the file is text in UTF-16: save it as UTF-8");
}

TEST(MeshFile, AsksForAsciiWhereTheUsdIsBinary) {
  const std::string crate = write("crate.usd", std::string("PXR-USDC\0\0\0\1", 12));
  EXPECT_EQ(usage_error([&] { read_mesh(crate); }),
            crate + ": this is a binary USD file (usdc); export it as ASCII, with the ending .usda");
  const std::string package = write("package.usd", "PK\x03\x04...");
  EXPECT_EQ(usage_error([&] { read_mesh(package); }),
            package + ": this is a packed USD file (usdz); export it as ASCII, with the ending .usda");
  const std::string stored = write("stored.usd", std::string("PK\x03\x04\x0a\0\0\0\0\0", 10));
  EXPECT_EQ(usage_error([&] { read_mesh(stored); }),
            stored + ": this is a packed USD file (usdz); export it as ASCII, with the ending .usda");
}

TEST(MeshFile, SaysWhatAnEmptyFileLacks) {
  const std::string obj = write("empty.obj", ""), usd = write("empty.usda", "");
  EXPECT_EQ(usage_error([&] { read_mesh(obj); }), obj + ": there is no vertex ('v x y z') in the file");
  EXPECT_EQ(usage_error([&] { read_mesh(usd); }), usd + ":1:1: expected '#usda 1.0', found ''");
}

double area(const std::vector<Eigen::Vector3d>& p, const std::array<std::size_t, 3>& t, const Eigen::Vector3d& normal) {
  return (p[t[1]] - p[t[0]]).cross(p[t[2]] - p[t[0]]).dot(normal) / 2;
}

TEST(Triangulation, OfAConvexPolygonIsAFanFromItsFirstCorner) {
  const std::vector<Eigen::Vector3d> square = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  const std::vector<std::array<std::size_t, 3>> fan = {{0, 1, 2}, {0, 2, 3}};
  EXPECT_EQ(triangulate(square), fan);
}

// Overlapping or outside triangles would make some area negative or the sum too large.
TEST(Triangulation, OfAConcavePolygonCoversItOnceInAnyPlane) {
  const std::vector<Eigen::Vector2d> comb = {{0, 0}, {5, 0}, {5, 3}, {4, 3}, {4, 1}, {3, 1},
                                             {3, 3}, {2, 3}, {2, 1}, {1, 1}, {1, 3}, {0, 3}};
  const double comb_area = 5 * 1 + 3 * 1 * 2;
  for (const auto& normal : {Eigen::Vector3d(0, 0, 1), Eigen::Vector3d(-1, 0, 0), Eigen::Vector3d(1, -2, 3)}) {
    const Eigen::Vector3d n = normal.normalized(), u = n.unitOrthogonal(), v = n.cross(u);
    for (std::size_t start = 0; start < comb.size(); ++start) {
      std::vector<Eigen::Vector3d> points;
      for (std::size_t i = 0; i < comb.size(); ++i) {
        const Eigen::Vector2d& p = comb[(start + i) % comb.size()];
        points.push_back(Eigen::Vector3d(100, -200, 300) + p.x() * u + p.y() * v);
      }
      const auto triangles = triangulate(points);
      ASSERT_EQ(triangles.size(), comb.size() - 2);
      double sum = 0;
      for (const auto& triangle : triangles) {
        EXPECT_GE(area(points, triangle, n), -1e-9);
        sum += area(points, triangle, n);
      }
      EXPECT_NEAR(sum, comb_area, 1e-9);
    }
  }
}

TEST(Triangulation, EndsForPolygonsThatCrossThemselvesOrAreFlat) {
  const std::vector<Eigen::Vector3d> bow_tie = {{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}, {-2, 3, 0}};
  EXPECT_EQ(triangulate(bow_tie).size(), 3U);
  const std::vector<Eigen::Vector3d> line = {{0, 0, 0}, {1, 0, 0}, {3, 0, 0}, {2, 0, 0}};
  EXPECT_EQ(triangulate(line).size(), 2U);
  EXPECT_EQ(triangulate(std::vector<Eigen::Vector3d>(6, Eigen::Vector3d::Zero())).size(), 4U);
}

}  // namespace
}  // namespace drape
