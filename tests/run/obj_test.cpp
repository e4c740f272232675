#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "output/registry.hpp"
#include "scene/mesh_value.hpp"
#include "tests/support/written_motion.hpp"

namespace drape::obj {
namespace {

/// Nine digits distinguish all single-precision numbers, the precision of OBJ readers.
void expect_same(const Vertices& read, const Vertices& expected) {
  ASSERT_EQ(read.rows(), expected.rows());
  for (Eigen::Index i = 0; i < expected.size(); ++i) {
    EXPECT_NEAR(read(i), expected(i), 6e-8 * std::abs(expected(i))) << "coordinate " << i;
  }
}

TEST(ObjSequence, ReadsBackAsTheFramesOfTheFilm) {
  const test::SceneFolder folder;
  const LoadedScene scene = folder.load(test::moving_scene);
  const auto [result, frames] = test::write_motion(scene, {folder.path("mesh{frame:04}.obj")});

  EXPECT_EQ(result.outcome, Outcome::completed);
  EXPECT_TRUE(result.renderer.empty());
  ASSERT_EQ(result.outputs.size(), 1U);
  ASSERT_EQ(result.outputs[0].size(), frames.size());
  EXPECT_EQ(frames.size(), 9U);
  for (std::size_t k = 0; k < frames.size(); ++k) {
    const OutputFile& file = result.outputs[0][k];
    EXPECT_EQ(file.path.filename(), "mesh000" + std::to_string(k) + ".obj");
    EXPECT_EQ(file.size, std::filesystem::file_size(file.path));
    const Mesh mesh = read_mesh(file.path);
    expect_same(mesh.positions, frames[k].positions);
    EXPECT_EQ(mesh.triangles, scene.simulation.cloth.triangles);
    EXPECT_EQ(mesh.uvs, scene.uvs);
  }
}

TEST(Obj, HoldsTheLastFrameWithoutANumber) {
  const test::SceneFolder folder;
  RunOptions options;
  options.records.positions = folder.path("end.csv");
  const RunResult result =
      test::write_motion(folder.load(test::moving_scene), {folder.path("end.obj")}, options).result;
  ASSERT_EQ(result.outputs.size(), 1U);
  EXPECT_EQ(result.outputs[0].size(), 1U);
  const Vertices mesh = read_mesh(folder.path("end.obj")).positions;
  std::istringstream table(test::content(folder.path("end.csv")));
  std::string row;
  std::getline(table, row);
  Vertices positions(mesh.rows(), 3);
  for (Eigen::Index i = 0; i < mesh.rows(); ++i) {
    std::getline(table, row);
    int vertex = 0;
    ASSERT_EQ(std::sscanf(row.c_str(), "%d,%lf,%lf,%lf", &vertex, &positions(i, 0), &positions(i, 1), &positions(i, 2)),
              4);
  }
  EXPECT_FALSE(std::getline(table, row));
  expect_same(mesh, positions);
}

TEST(Obj, HasTextureCoordinatesOnlyWhereTheMeshHasThem) {
  const test::SceneFolder folder;
  folder.write("bare.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  folder.write("seam.obj",
               "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nvt 0 0\nvt 0.3 0.1\nvt 0.7 0.9\nvt 1 1\n"
               "f 1/1 2/2 3/3\nf 3/4 2/2 4/1\n");
  for (const std::string name : {"bare", "seam"}) {
    const LoadedScene scene =
        folder.load("[cloth]\nmesh = \"" + name + ".obj\"\nstiffness = 10\n[time]\nstep = 0.01\n" +
                    "duration = 0.01\n[effects.gravity]\n");
    test::write_motion(scene, {folder.path("out.obj")});
    const Mesh mesh = read_mesh(folder.path("out.obj")), given = read_mesh(folder.path(name + ".obj"));
    EXPECT_EQ(mesh.uvs, given.uvs) << name;
    EXPECT_EQ(mesh.triangles, given.triangles) << name;
    EXPECT_EQ(test::content(folder.path("out.obj")).find("vt ") == std::string::npos, name == "bare");
  }
}

TEST(Obj, TellsNumbersInSinglePrecisionApart) {
  const test::SceneFolder folder;
  Cloth cloth;
  cloth.triangles = {{0, 1, 2}};
  FilmInfo film;
  film.cloth = &cloth;
  Frame frame;
  frame.positions = Vertices(3, 3);
  frame.positions << 0.1F, std::nextafter(0.1F, 1.0F), 1e-20F, -16777217.0F, 3.14159274F, 1 / 3.0F, 0, 1, 5e5F;
  const AnySink any = make_sink(folder.path("x.obj"), film);
  const auto& sink = std::get<std::unique_ptr<MotionWriter>>(any);
  sink->add(frame);
  sink->finish();
  EXPECT_EQ(read_mesh(folder.path("x.obj")).positions.cast<float>(), frame.positions.cast<float>());
}

}  // namespace
}  // namespace drape::obj
