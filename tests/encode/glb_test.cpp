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
      Frame frame{.index = k, .time = 0.04 * k, .positions = cloth.positions};
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

TEST_F(Glb, RefusesTooManyFramesBeforeTheFirst) {
  film.expected_frames = 3000;
  EXPECT_NO_THROW(GlbWriter(path("x.glb"), film));
  film.expected_frames = 3001;
  EXPECT_THROW(GlbWriter(path("x.glb"), film), UsageError);
}

TEST_F(Glb, HasNoAnimationWhereNothingMoves) {
  write(0);
  EXPECT_FALSE(json.contains("animations"));
  EXPECT_FALSE(json["meshes"][0]["primitives"][0].contains("targets"));
}

TEST_F(Glb, HasAMeshAndAMaterialForEachCloth) {
  Cloth napkin = cloth;
  napkin.positions.rowwise() += Eigen::RowVector3d(5, 0, 1);
  Cloth both;
  append("table-cloth", cloth, both);
  append("napkin", napkin, both);
  cloth = both;
  uvs.insert(uvs.end(), grid.uvs.begin(), grid.uvs.end());
  Look look;
  look.cloths = {{.first_triangle = 0, .color = {1, 0, 0}}, {.first_triangle = 8, .color = {0, 0, 1}}};
  film.look = &look;
  write(0.25);
  ASSERT_EQ(json["meshes"].size(), 4U);  // and the ball and the ground
  for (std::size_t k = 0; k < 2; ++k) {
    const std::string name = both.pieces[k].name;
    EXPECT_EQ(json["nodes"][1 + k]["name"], name);
    EXPECT_EQ(json["nodes"][1 + k]["mesh"], k);
    EXPECT_EQ(json["meshes"][k]["name"], name);
    const Json& primitive = json["meshes"][k]["primitives"][0];
    const auto position = primitive["attributes"]["POSITION"].get<std::size_t>();
    EXPECT_EQ(json["accessors"][position]["count"], 9);
    EXPECT_EQ(json["accessors"][primitive["indices"].get<std::size_t>()]["count"], 24);
    EXPECT_EQ(first_of(primitive["attributes"]["POSITION"]), both.positions.row(9 * k).cast<float>().transpose());
    EXPECT_EQ(first_of(primitive["targets"][1]["POSITION"]), Eigen::Vector3f(0, 0, 0.5F));
    const Json& material = json["materials"][primitive["material"].get<std::size_t>()];
    EXPECT_EQ(material["name"], name);
    EXPECT_EQ(material["pbrMetallicRoughness"]["baseColorFactor"][2 * k], 1.0);
    EXPECT_EQ(material["pbrMetallicRoughness"]["baseColorFactor"][2 - 2 * k], 0.0);
  }
  EXPECT_EQ(json["materials"].size(), 5U);
  EXPECT_EQ(json["materials"][json["meshes"][2]["primitives"][0]["material"].get<std::size_t>()]["name"], "sphere");
  EXPECT_EQ(json["materials"][json["meshes"][3]["primitives"][0]["material"].get<std::size_t>()]["name"], "ground");
  const Json& channels = json["animations"][0]["channels"];
  ASSERT_EQ(channels.size(), 3U);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(channels[k]["target"]["node"], 1 + k);
  EXPECT_EQ(channels[2]["target"]["path"], "translation");
}

TEST_F(Glb, StoresATextureOnceForAllClothsThatHaveIt) {
  Cloth both;
  for (const char* name : {"a", "b", "c"}) append(name, cloth, both);
  cloth = both;
  for (int k = 0; k < 2; ++k) uvs.insert(uvs.end(), grid.uvs.begin(), grid.uvs.end());
  const std::filesystem::path plaid = std::filesystem::path(DRAPE_SOURCE_DIR) / "textures/plaid.png";
  Look look;
  look.cloths = {{.first_triangle = 0, .color = {1, 0, 0}, .texture = plaid},
                 {.first_triangle = 8, .color = {0, 1, 0}},
                 {.first_triangle = 16, .color = {0, 0, 1}, .texture = plaid}};
  film.look = &look;
  write(0.25);
  EXPECT_EQ(json["images"].size(), 1U);
  EXPECT_EQ(json["textures"].size(), 1U);
  const Json& image = json["bufferViews"][json["images"][0]["bufferView"].get<std::size_t>()];
  EXPECT_EQ(binary.substr(image["byteOffset"].get<std::size_t>(), image["byteLength"].get<std::size_t>()),
            content(plaid));
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(json["materials"][k]["pbrMetallicRoughness"].contains("baseColorTexture"), k != 1) << k;
  }
}

TEST_F(Glb, RepeatsAVertexThatHasSeveralTextureCoordinates) {
  uvs[0] = {0.125F, 0.75F};
  write(0.25);
  const Json& primitive = json["meshes"][0]["primitives"][0];
  EXPECT_EQ(json["accessors"][primitive["attributes"]["POSITION"].get<std::size_t>()]["count"], 10);
}

}  // namespace
}  // namespace drape::test
