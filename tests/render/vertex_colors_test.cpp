#include <gtest/gtest.h>

#include <cstdlib>

#include "tests/render/drawing.hpp"

namespace drape::test {
namespace {

class VertexColors : public ::testing::Test {
 protected:
  VertexColors() { frame_.positions = mesh_.positions; }

  [[nodiscard]] Renderer renderer(const Look& look) const {
    return {data_folder(), {120, 100}, from_above(), look, 9, mesh_.triangles, mesh_.uvs};
  }

  Mesh mesh_ = make_grid(2, 2);
  Frame frame_;
};

TEST_F(VertexColors, AreReadAsTheyAreInAnyLight) {
  const Rgb color{0.2, 0.6, 0.4};
  Look dark;
  dark.exposure = 0.2;
  for (const Look& look : {Look{}, dark}) {
    const Image colored = renderer(look).draw(frame_, std::vector<Rgb>(9, color));
    const std::uint8_t* middle = colored.at(60, 50);
    for (const auto& [channel, value] : {std::pair(0, color.r), {1, color.g}, {2, color.b}}) {
      EXPECT_NEAR(middle[channel], 255 * value, 3) << channel;
    }
  }
}

TEST_F(VertexColors, AreWhereTheirVerticesAreAndDoNotStay) {
  Look look;
  look.texture = data_folder() / "textures/plaid.png";
  Renderer r = renderer(look);
  const Image plain = r.draw(frame_);
  std::vector<Rgb> colors(9, Rgb{0, 0, 1});
  for (const std::size_t left : {0U, 3U, 6U}) colors[left] = {1, 0, 0};  // x = −1
  const Image colored = r.draw(frame_, colors);
  const std::uint8_t* left = colored.at(15, 50);
  const std::uint8_t* right = colored.at(100, 50);
  EXPECT_GT(left[0], 2 * left[2]);
  EXPECT_GT(right[2], 100);
  EXPECT_LT(right[0], 60);
  EXPECT_EQ(r.draw(frame_), plain);
}

TEST_F(VertexColors, MustBeOneForEachVertex) {
  Renderer r = renderer({});
  EXPECT_THROW(r.draw(frame_, std::vector<Rgb>(8)), std::invalid_argument);
  EXPECT_THROW(r.draw(frame_, std::vector<Rgb>()), std::invalid_argument);
}

}  // namespace
}  // namespace drape::test
