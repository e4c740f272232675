// Binary glTF: its chunks, and positions read back by the specification.

#include <gtest/gtest.h>

#include <cstring>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <utility>

#include "output/codecs/codecs.hpp"
#include "output/glb_writer.hpp"
#include "tests/support/files.hpp"
#include "tests/support/random.hpp"
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

  /// Writes three frames, in which the cloth may rise, and a ball that may rise and grow.
  void write(double rise, double growth = 0) {
    film.expected_frames = 3;
    GlbWriter writer(path("x.glb"), film);
    for (int k = 0; k < 3; ++k) {
      Frame frame{.index = k, .time = 0.04 * k, .positions = cloth.positions};
      frame.positions.col(2).array() += rise * k;
      frame.colliders = {SphereShape{.center = {0, 0, 0.5 * rise * k}, .radius = 0.3 + growth * k},
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

  /// Returns x, y and z of an accessor's element.
  [[nodiscard]] Eigen::Vector3f element_of(int accessor, std::size_t k) const {
    const Json& of = json["accessors"][static_cast<std::size_t>(accessor)];
    const Json& view = json["bufferViews"][of["bufferView"].get<std::size_t>()];
    const std::size_t at = view["byteOffset"].get<std::size_t>() + of["byteOffset"].get<std::size_t>() + 12 * k;
    Eigen::Vector3f v;
    std::memcpy(v.data(), binary.data() + at, 12);
    return v;
  }
  [[nodiscard]] Eigen::Vector3f first_of(int accessor) const { return element_of(accessor, 0); }

  /// Writes a file with a texture of the given bytes. @returns the type and the bytes of its image
  std::pair<std::string, std::string> write_textured(const std::string& name, const std::string& bytes) {
    Look look;
    look.texture = put(path(name), bytes);
    film.look = &look;
    write(0);
    film.look = nullptr;
    if (!json.contains("images")) return {};
    const Json& view = json["bufferViews"][json["images"][0]["bufferView"].get<std::size_t>()];
    return {json["images"][0]["mimeType"], binary.substr(view["byteOffset"], view["byteLength"])};
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

TEST_F(Glb, ScalesASphereThatGrows) {
  write(0, 0.15);
  const Json& animation = json["animations"][0];
  ASSERT_EQ(animation["channels"].size(), 1U);
  EXPECT_EQ(animation["channels"][0]["target"], Json({{"node", 2}, {"path", "scale"}}));
  const int scales = animation["samplers"][0]["output"];
  EXPECT_EQ(json["accessors"][static_cast<std::size_t>(scales)]["type"], "VEC3");
  EXPECT_EQ(json["accessors"][static_cast<std::size_t>(scales)]["count"], 3);
  for (std::size_t k = 0; k < 3; ++k) {
    const Eigen::Vector3f expected = Eigen::Vector3f::Constant(1 + 0.5F * static_cast<float>(k));
    EXPECT_LT((element_of(scales, k) - expected).norm(), 1e-6F) << k;
  }
  write(0.25, 0.15);
  EXPECT_EQ(json["animations"][0]["channels"].size(), 3U);  // weights, translation and scale
}

TEST_F(Glb, StoresTexturesOfOtherFormatsAsPng) {
  Random random(5);
  cv::Mat picture(5, 7, CV_8UC3);
  for (std::size_t i = 0; i < 3 * picture.total(); ++i) picture.data[i] = static_cast<std::uint8_t>(random.below(256));
  cv::Mat gray;
  cv::extractChannel(picture, gray, 0);
  const auto encoded = [](const std::string& extension, const cv::Mat& image) {
    std::vector<std::uint8_t> bytes;
    cv::imencode(extension, image, bytes);
    return std::string(bytes.begin(), bytes.end());
  };
  for (const auto& [name, bytes] : {std::pair{"a.bmp", encoded(".bmp", picture)},
                                    {"a.tif", encoded(".tif", picture)},
                                    {"a.webp", encoded(".webp", picture)},
                                    {"gray.jpg", encoded(".jpg", gray)}}) {
    const auto [type, image] = write_textured(name, bytes);
    EXPECT_EQ(type, "image/png") << name;
    EXPECT_EQ(cv::norm(bgr_from_png(image), decode_picture(bytes, cv::IMREAD_COLOR), cv::NORM_INF), 0) << name;
  }
  const std::string jpeg = encoded(".jpg", picture);
  EXPECT_EQ(write_textured("a.jpg", jpeg), std::pair(std::string("image/jpeg"), jpeg));
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
