// Each of several cloths is drawn in its own colour or texture.

#include <gtest/gtest.h>

#include "tests/render/drawing.hpp"

namespace drape::test {
namespace {

/// Returns a level square in two halves: the triangles of the left one come first.
Mesh halves() {
  Mesh mesh;
  mesh.positions.resize(8, 3);
  mesh.positions << -1, -1, 0, -0.1, -1, 0, -0.1, 1, 0, -1, 1, 0, 0.1, -1, 0, 1, -1, 0, 1, 1, 0, 0.1, 1, 0;
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {4, 5, 6}, {4, 6, 7}};
  return mesh;
}

/// Returns the amounts of red and blue at a place of a picture, from 0 at the left to 1.
std::array<int, 2> red_and_blue(const Image& image, double place) {
  const auto x = static_cast<std::size_t>(place * image.width), y = static_cast<std::size_t>(image.height / 2);
  const std::size_t at = 3 * (y * static_cast<std::size_t>(image.width) + x);
  return {image.pixels[at], image.pixels[at + 2]};
}

TEST(ClothLooks, ColourEachClothByItself) {
  for (const bool shadows : {true, false}) {
    Look look;
    look.shadows = shadows;
    look.cloths = {{.first_triangle = 0, .color = {1, 0, 0}}, {.first_triangle = 2, .color = {0, 0, 1}}};
    const Image image = draw(halves(), from_above(), look, {100, 100});
    const auto left = red_and_blue(image, 0.25), right = red_and_blue(image, 0.75);
    EXPECT_GT(left[0], 2 * left[1]) << shadows;
    EXPECT_GT(right[1], 2 * right[0]) << shadows;
  }
}

TEST(ClothLooks, PutATextureOnOneClothOnly) {
  Mesh mesh = halves();
  mesh.uvs.assign(12, {0, 0});
  for (std::size_t corner = 6; corner < 12; ++corner) {
    const int vertex = mesh.triangles[corner / 3][corner % 3];
    mesh.uvs[corner] = {static_cast<float>(mesh.positions(vertex, 0)), static_cast<float>(mesh.positions(vertex, 1))};
  }
  Look look;
  look.cloths = {{.first_triangle = 0, .color = {1, 0, 0}},
                 {.first_triangle = 2, .color = {1, 0, 0}, .texture = data_folder() / "textures/plaid.png"}};
  const Image textured = draw(mesh, from_above(), look, {100, 100});
  look.cloths[1].texture.clear();
  const Image plain = draw(mesh, from_above(), look, {100, 100});
  EXPECT_EQ(red_and_blue(textured, 0.25), red_and_blue(plain, 0.25));
  EXPECT_NE(red_and_blue(textured, 0.75), red_and_blue(plain, 0.75));
}

}  // namespace
}  // namespace drape::test
