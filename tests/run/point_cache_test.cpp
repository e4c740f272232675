#include <gtest/gtest.h>

#include "output/registry.hpp"
#include "scene/mesh_value.hpp"
#include "tests/support/written_motion.hpp"

namespace drape::point_cache {
namespace {

using test::number_at;
using test::vertices_at;

constexpr std::size_t head = 32;

TEST(PointCache, HoldsTheMotionOfTheMeshBesideIt) {
  const test::SceneFolder folder;
  const LoadedScene scene = folder.load(test::moving_scene);
  const auto [result, frames] = test::write_motion(scene, {folder.path("x.pc2")});
  const std::string cache = test::content(folder.path("x.pc2"));
  EXPECT_EQ(cache.substr(0, 12), std::string("POINTCACHE2\0", 12));
  EXPECT_EQ(number_at<std::int32_t>(cache, 12), 1);
  EXPECT_EQ(number_at<std::int32_t>(cache, 16), 20);
  EXPECT_EQ(number_at<float>(cache, 20), 0);
  EXPECT_EQ(number_at<float>(cache, 24), 1);
  EXPECT_EQ(number_at<std::int32_t>(cache, 28), 9);
  ASSERT_EQ(cache.size(), head + std::size_t{9} * 20 * 12);
  for (std::size_t k = 0; k < frames.size(); ++k) {
    EXPECT_EQ(vertices_at<float>(cache, head + k * 240, 20).cast<float>(), frames[k].positions.cast<float>()) << k;
  }
  const Mesh mesh = read_mesh(folder.path("x.obj"));
  EXPECT_LT((mesh.positions - frames[0].positions).cwiseAbs().maxCoeff(), 1e-8);
  EXPECT_EQ(mesh.triangles, scene.simulation.cloth.triangles);
}

TEST(PointCache, SaysHowManySamplesThereAreWhereTheMotionEndsEarly) {
  const test::SceneFolder folder;
  FilmInfo film;
  film.expected_frames = 1000;
  const AnySink any = make_sink(folder.path("x.pc2"), film);
  Frame frame;
  frame.positions = Vertices::Constant(2, 3, 0.5);
  for (int k = 0; k < 3; ++k) std::get<std::unique_ptr<MotionWriter>>(any)->add(frame);
  std::get<std::unique_ptr<MotionWriter>>(any)->finish(Ending::early);
  const std::string cache = test::content(folder.path("x.partial.pc2"));
  EXPECT_EQ(number_at<std::int32_t>(cache, 28), 3);
  EXPECT_EQ(cache.size(), head + std::size_t{3} * 2 * 12);
  EXPECT_TRUE(std::filesystem::exists(folder.path("x.partial.obj")));
  EXPECT_EQ(folder.file_count(), 2U);
}

TEST(PointCache, ItsMeshIsAFileLikeAnyOther) {
  const std::vector<std::string> files = output_files("out/x.pc2", {});
  EXPECT_EQ(files, (std::vector<std::string>{"out/x.pc2", "out/x.obj"}));
}

TEST(Ply, HoldsAFrameToTheBit) {
  const test::SceneFolder folder;
  const LoadedScene scene = folder.load(test::moving_scene);
  const auto [result, frames] = test::write_motion(scene, {folder.path("{frame:04}.ply")});
  const std::vector<Triangle>& triangles = scene.simulation.cloth.triangles;
  for (std::size_t k = 0; k < frames.size(); ++k) {
    const std::string ply = test::content(folder.path("000" + std::to_string(k) + ".ply"));
    EXPECT_TRUE(ply.starts_with("ply\nformat binary_little_endian 1.0\n"));
    EXPECT_NE(ply.find("\nelement vertex 20\nproperty double x\nproperty double y\nproperty double z\n"),
              std::string::npos);
    EXPECT_NE(ply.find("\nelement face 24\nproperty list uchar int vertex_indices\nend_header\n"), std::string::npos);
    const std::size_t data = ply.find("end_header\n") + 11;
    EXPECT_EQ(vertices_at<double>(ply, data, 20), frames[k].positions);
    const std::size_t faces = data + 480;
    ASSERT_EQ(ply.size(), faces + std::size_t{24} * 13);
    for (std::size_t i = 0; i < 72; ++i) {
      EXPECT_EQ(number_at<std::uint8_t>(ply, faces + i / 3 * 13), 3);
      EXPECT_EQ(number_at<std::int32_t>(ply, faces + i / 3 * 13 + 1 + i % 3 * 4), triangles[i / 3][i % 3]);
    }
  }
}

}  // namespace
}  // namespace drape::point_cache
