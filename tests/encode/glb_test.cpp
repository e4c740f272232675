// Binary glTF: its chunks, and positions read back by the specification.

#include <gtest/gtest.h>

#include <cstring>
#include <nlohmann/json.hpp>

#include "output/glb_writer.hpp"
#include "tests/support/files.hpp"
#include "tests/support/scratch_folder.hpp"

namespace drape::test {
namespace {

using Json = nlohmann::json;

class Glb : public InScratchFolder {
 protected:
  Glb() {
    cloth.velocities = Vertices::Zero(9, 3);
    film.cloth = &cloth;
    film.uvs = &uvs;
  }

  /// Writes three frames, in which the cloth may rise, and a ball.
  void write(double rise) {
    film.expected_frames = 3;
    GlbWriter writer(path("x.glb"), film);
    for (int k = 0; k < 3; ++k) {
      Frame frame{.index = k, .time = 0.04 * k, .positions = grid.positions};
      frame.positions.col(2).array() += rise * k;
      frame.colliders = {SphereShape{.center = {0, 0, 0.5 * rise * k}, .radius = 0.3},
                         GroundShape{.normal = Eigen::Vector3d::UnitZ(), .height = -1}};
      writer.add(frame);
    }
    writer.finish(Ending::complete);
    const std::string bytes = content(path("x.glb"));
    const auto word = [&](std::size_t at) {
      std::uint32_t value = 0;
      std::memcpy(&value, bytes.data() + at, 4);
      return value;
    };
    ASSERT_TRUE(bytes.starts_with("glTF"));
    EXPECT_EQ(word(4), 2U);
    EXPECT_EQ(word(8), bytes.size());
    const std::uint32_t size = word(12);
    EXPECT_EQ(bytes.substr(16, 4), "JSON");
    json = Json::parse(bytes.substr(20, size));
    EXPECT_EQ(bytes.substr(24 + size, 4), std::string("BIN\0", 4));
    EXPECT_EQ(28 + size + word(20 + size), bytes.size());
    binary = bytes.substr(28 + size);
  }

  /// Returns x, y and z of an accessor's first element.
  [[nodiscard]] Eigen::Vector3f first_of(int accessor) const {
    const Json& of = json["accessors"][static_cast<std::size_t>(accessor)];
    const Json& view = json["bufferViews"][of["bufferView"].get<std::size_t>()];
    const std::size_t at = view["byteOffset"].get<std::size_t>() + of["byteOffset"].get<std::size_t>();
    Eigen::Vector3f v;
    std::memcpy(v.data(), binary.data() + at, 12);
    return v;
  }

  const Mesh grid = make_grid(2, 2);
  Cloth cloth = make_cloth(grid, grid, 1, 10, {});
  std::vector<std::array<float, 2>> uvs = grid.uvs;
  FilmInfo film;
  Json json;
  std::string binary;
};

TEST_F(Glb, HasAMorphTargetForEachFrameAfterTheFirst) {
  write(0.25);
  const Json& cloth_mesh = json["meshes"][0];
  const Json& primitive = cloth_mesh["primitives"][0];
  ASSERT_EQ(primitive["targets"].size(), 2U);
  EXPECT_EQ(cloth_mesh["weights"], Json({0, 0}));
  EXPECT_EQ(first_of(primitive["attributes"]["POSITION"]), Eigen::Vector3f(-1, -1, 0));
  EXPECT_EQ(first_of(primitive["targets"][0]["POSITION"]), Eigen::Vector3f(0, 0, 0.25F));
  EXPECT_EQ(first_of(primitive["targets"][1]["POSITION"]), Eigen::Vector3f(0, 0, 0.5F));
  EXPECT_EQ(first_of(primitive["attributes"]["NORMAL"]), Eigen::Vector3f(0, 0, 1));
  EXPECT_EQ(json["accessors"][primitive["attributes"]["POSITION"].get<std::size_t>()]["count"], 9);
  const Json& animation = json["animations"][0];
  EXPECT_EQ(animation["channels"].size(), 2U);  // the cloth's weights, and the ball's position
  EXPECT_EQ(animation["channels"][1]["target"]["path"], "translation");
  EXPECT_EQ(json["buffers"][0]["byteLength"].get<std::size_t>() / 4, binary.size() / 4);
}

TEST_F(Glb, HasNoAnimationWhereNothingMoves) {
  write(0);
  EXPECT_FALSE(json.contains("animations"));
  EXPECT_FALSE(json["meshes"][0]["primitives"][0].contains("targets"));
}

TEST_F(Glb, RepeatsAVertexThatHasSeveralTextureCoordinates) {
  uvs[0] = {0.125F, 0.75F};
  write(0.25);
  const Json& primitive = json["meshes"][0]["primitives"][0];
  EXPECT_EQ(json["accessors"][primitive["attributes"]["POSITION"].get<std::size_t>()]["count"], 10);
}

}  // namespace
}  // namespace drape::test
