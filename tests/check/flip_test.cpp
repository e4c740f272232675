#include "render/flip.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <functional>
#include <numeric>

#include "tests/support/synthetic_film.hpp"

namespace drape {
namespace {

constexpr int width = 64, height = 48;
using Pixel = std::array<int, 3>;

Image image_of(const std::function<Pixel(int, int)>& color) {
  Image image(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const Pixel pixel = color(x, y);
      std::copy(pixel.begin(), pixel.end(), image.at(x, y));
    }
  }
  return image;
}

/// Returns gradients, moiré and a chessboard, one per channel.
Pixel pattern(int x, int y) { return {(4 * x + 2 * y) % 256, x * y % 256, (x / 8 + y / 8) % 2 * 200 + 20}; }

Pixel brighter(int x, int y) {
  Pixel pixel = pattern(x, y);
  for (int& channel : pixel) channel = std::min(channel + 3, 255);
  return pixel;
}

struct Reference {
  const char* name;
  std::function<Pixel(int, int)> test;
  double mean, largest;
  std::array<double, 5> at;  // errors of the pixels below
};

constexpr std::array<std::array<int, 2>, 5> places{{{0, 0}, {24, 14}, {19, 12}, {63, 47}, {33, 29}}};

class Flip : public ::testing::TestWithParam<Reference> {};

// Reference values of the authors' own program (flip_api.py of NVlabs/flip 1.2), in double precision.
INSTANTIATE_TEST_SUITE_P(
    Of, Flip,
    ::testing::Values(Reference{"block",
                                [](int x, int y) {
                                  return x >= 20 && x < 28 && y >= 10 && y < 18 ? Pixel{255, 255, 255} : pattern(x, y);
                                },
                                0.040545,
                                0.984289,
                                {0, 0.979193, 0.670373, 0, 0}},
                      Reference{"shift",
                                [](int x, int y) { return pattern(std::max(x - 1, 0), y); },
                                0.317886,
                                0.810896,
                                {0.023955, 0.320384, 0.177944, 0.309592, 0.370471}},
                      Reference{
                          "brighter", brighter, 0.081626, 0.108796, {0.052517, 0.083192, 0.083242, 0.103662, 0.070996}},
                      Reference{"swapped",
                                [](int x, int y) {
                                  const Pixel p = pattern(x, y);
                                  return Pixel{p[2], p[1], p[0]};
                                },
                                0.597752,
                                0.968067,
                                {0.050177, 0.472442, 0.806243, 0.439243, 0.301721}}),
    [](const auto& tested) { return tested.param.name; });

TEST_P(Flip, AgreesWithItsAuthorsProgram) {
  const Reference& expected = GetParam();
  const ErrorMap map = flip_error(image_of(pattern), image_of(expected.test));
  constexpr double tolerance = 1e-5;  // the program rounds the colour space's matrices to nine digits
  const double sum = std::accumulate(map.values.begin(), map.values.end(), 0.0);
  EXPECT_NEAR(sum / static_cast<double>(map.values.size()), expected.mean, tolerance);
  EXPECT_NEAR(*std::max_element(map.values.begin(), map.values.end()), expected.largest, tolerance);
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto [x, y] = places[i];
    EXPECT_NEAR(map.values[static_cast<std::size_t>(y * width + x)], expected.at[i], tolerance) << x << ' ' << y;
  }
}

struct ColorPair {
  test::Color a, b;
  double error;
};

TEST(FlipOfPlainColors, AgreesWithItsAuthorsProgram) {
  const std::array<ColorPair, 5> pairs{{{{0, 0, 0}, {255, 255, 255}, 0.967380},
                                        {{0, 255, 0}, {0, 0, 255}, 1},
                                        {{255, 0, 0}, {0, 255, 0}, 0.986662},
                                        {{128, 128, 128}, {129, 129, 129}, 0.029855},
                                        {{200, 30, 30}, {203, 30, 30}, 0.079258}}};
  for (const ColorPair& pair : pairs) {
    const ErrorMap map = flip_error(test::plain_image(8, 8, pair.a), test::plain_image(8, 8, pair.b));
    for (const float value : map.values) EXPECT_NEAR(value, pair.error, 1e-5);
  }
}

TEST(FlipOfPlainColors, IsZeroForTheSamePictureAndTheSameBothWays) {
  const Image a = test::synthetic_frame(0, 80, 60), b = test::synthetic_frame(3, 80, 60);
  for (const float value : flip_error(a, a).values) EXPECT_EQ(value, 0);
  EXPECT_EQ(flip_error(a, b).values, flip_error(b, a).values);
}

TEST(FlipOfPlainColors, AssumesADisplayOf67PixelsPerDegree) {
  EXPECT_NEAR(default_pixels_per_degree(), 67.0206, 1e-4);  // Andersson et al. 2020, section 6
}

TEST(FlipMap, GoesFromBlackToPaleYellow) {
  const Image colors = magma({.width = 2, .height = 1, .values = {0, 1}});
  EXPECT_LT(*std::max_element(colors.at(0, 0), colors.at(0, 0) + 3), 10);
  EXPECT_GT(colors.at(1, 0)[0], 240);
  EXPECT_GT(colors.at(1, 0)[1], 240);
  EXPECT_LT(colors.at(1, 0)[2], 210);
}

}  // namespace
}  // namespace drape
