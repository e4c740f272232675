#include "render/draw_cloth.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/render/drawing.hpp"

namespace drape::test {
namespace {

/// Draws a square cloth of this side from above, facing the camera and filling the picture's height.
Image drawn(double side, bool woven, Eigen::Vector2i size = {300, 300}) {
  Mesh mesh = make_grid(8, 8);
  mesh.positions.rowwise() -= mesh.positions.colwise().mean();
  mesh.positions *= side / (mesh.positions.col(0).maxCoeff() - mesh.positions.col(0).minCoeff());
  View view = from_above();
  view.position *= side / 2;
  Look look;
  look.thickness = 0;
  Renderer renderer(data_folder(), size, view, look, static_cast<int>(mesh.positions.rows()), mesh.triangles, mesh.uvs);
  if (woven) renderer.set_weave(mesh.positions, mesh.uvs);
  return renderer.draw({.positions = mesh.positions});
}

/// Returns the linear light along a row of pixels in the middle of a picture.
std::vector<double> middle_row(const Image& image) {
  std::vector<double> row;
  for (int x = image.width / 4; x < 3 * image.width / 4; ++x)
    row.push_back(to_linear(image.at(x, image.height / 2)[0]));
  return row;
}

double mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

/// Returns the amplitude of a wave in a row, relative to the mean.
double amplitude(const std::vector<double>& row, double pixels_per_wave) {
  double cosine = 0, sine = 0;
  for (std::size_t i = 0; i < row.size(); ++i) {
    const double phase = 2 * 3.14159265358979323846 * static_cast<double>(i) / pixels_per_wave;
    cosine += (row[i] - mean(row)) * std::cos(phase);
    sine += (row[i] - mean(row)) * std::sin(phase);
  }
  return 2 * std::hypot(cosine, sine) / static_cast<double>(row.size()) / mean(row);
}

// A cloth of 24 mm has 30 yarns of 0.8 mm, 10 pixels each; in a plain weave every second one is on top.
TEST(Weave, HasYarnsOfItsWidthFromNear) {
  const std::vector<double> row = middle_row(drawn(0.024, true));
  EXPECT_GT(std::max(amplitude(row, 10), amplitude(row, 20)), 0.05);
  for (const double other : {7.0, 14.0, 30.0, 50.0}) {
    EXPECT_LT(amplitude(row, other), 0.3 * std::max(amplitude(row, 10), amplitude(row, 20))) << other;
  }
}

TEST(Weave, KeepsTheClothsBrightness) {
  double woven = 0, plain = 0;
  const Image with = drawn(0.024, true), without = drawn(0.024, false);
  for (int y = 75; y < 225; ++y) {
    for (int x = 75; x < 225; ++x) {
      woven += to_linear(with.at(x, y)[0]);
      plain += to_linear(without.at(x, y)[0]);
    }
  }
  EXPECT_NEAR(woven / plain, 1, 0.02);
}

// From afar nothing of it is left, so there is no moiré, and pictures keep their bytes.
TEST(Weave, IsNotThereFromAfar) {
  for (const double side : {0.1, 0.2, 0.3, 0.5, 1.0, 3.0}) EXPECT_EQ(drawn(side, true), drawn(side, false)) << side;
}

// Coarser waves than the weave's own would be moiré.
TEST(Weave, FadesWithoutMoire) {
  for (double side = 0.03; side < 0.1; side *= 1.07) {
    const std::vector<double> row = middle_row(drawn(side, true));
    const double yarn = 300 * Weave::yarn_width / side;  // [pixels]
    for (double wave = 2.5 * yarn + 5; wave < 75; wave += 5)
      EXPECT_LT(amplitude(row, wave), 0.02) << side << " " << wave;
  }
}

// Coordinates whose unit is three times as long in one half of the cloth as in the other make its yarns wider there.
TEST(Weave, IsDrawnWhereverItsYarnsAreWideEnough) {
  Mesh mesh = make_grid(8, 8);
  mesh.positions.rowwise() -= mesh.positions.colwise().mean();
  mesh.positions *= 0.12 / (mesh.positions.col(0).maxCoeff() - mesh.positions.col(0).minCoeff());
  View view = from_above();
  view.position *= 0.06;
  const Frame frame{.positions = mesh.positions};
  const Shot shot(frame, view, 1, Look{});
  EXPECT_FALSE(Weave(mesh.positions, mesh.triangles, mesh.uvs).visible(shot, 300)) << "yarns of 2 pixels";
  for (auto& uv : mesh.uvs) uv[0] = uv[0] < 0.5F ? uv[0] / 3 : uv[0] - 1.0F / 3;
  EXPECT_TRUE(Weave(mesh.positions, mesh.triangles, mesh.uvs).visible(shot, 300)) << "yarns of 3 pixels";
}

TEST(Weave, KeepsTheScaleOfAnyTextureCoordinates) {
  Mesh mesh = make_grid(4, 4);
  mesh.positions.col(0) *= 3;
  const double u = mesh.positions.col(0).maxCoeff() - mesh.positions.col(0).minCoeff(),
               v = mesh.positions.col(1).maxCoeff() - mesh.positions.col(1).minCoeff();
  for (auto& uv : mesh.uvs) uv = {5 * uv[0], 0.5F * uv[1]};
  const Weave weave(mesh.positions, mesh.triangles, mesh.uvs);
  EXPECT_NEAR(weave.yarns().x(), u / 5 / Weave::yarn_width, 1e-3 * weave.yarns().x());
  EXPECT_NEAR(weave.yarns().y(), v / 0.5 / Weave::yarn_width, 1e-3 * weave.yarns().y());
  EXPECT_TRUE(Weave(mesh.positions, mesh.triangles, {}).yarns().isZero()) << "without coordinates there is no weave";
}

}  // namespace
}  // namespace drape::test
