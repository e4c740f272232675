#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "drape/core/rotation.hpp"
#include "tests/render/drawing.hpp"
#include "tests/support/random.hpp"

namespace drape::test {
namespace {

using Eigen::Array3d;
using Eigen::Vector3d;

/// Makes a curtain of eight folds that widen downwards, 1.6 m × 1.6 m.
Mesh curtain() {
  Mesh mesh = make_grid(96, 48);
  for (Eigen::Index i = 0; i < mesh.positions.rows(); ++i) {
    const double x = 0.8 * mesh.positions(i, 0), height = 0.5 + 0.5 * mesh.positions(i, 1);
    mesh.positions.row(i) << x, (0.05 - 0.015 * height) * std::sin(10 * std::numbers::pi * x), 1.6 * height - 0.8;
  }
  return mesh;
}

View before_the_curtain() { return {{0.95, -3.55, 0.5}, {0, 0, 0}, {0, 0, 1}, 30}; }

struct Measured {
  double deviation_by_mean = 0;  ///< of the luma 0.2126 R + 0.7152 G + 0.0722 B of the bytes
  double mean = 0;               ///< of the luma, from 0 to 1
  double clipped = 0;            ///< fraction of pixels with a channel of 254 or more
};

/// Measures the curtain's pixels: those that differ from a picture without it.
Measured measure(const Look& look) {
  const Eigen::Vector2i size{300, 300};
  const Image image = draw(curtain(), before_the_curtain(), look, size);
  const Image empty = draw(nothing(), before_the_curtain(), look, size);
  std::vector<double> values;
  int clipped = 0;
  for (int y = 0; y < size.y(); ++y) {
    for (int x = 0; x < size.x(); ++x) {
      const std::uint8_t* p = image.at(x, y);
      if (std::equal(p, p + 3, empty.at(x, y))) continue;
      values.push_back((0.2126 * p[0] + 0.7152 * p[1] + 0.0722 * p[2]) / 255);
      clipped += *std::max_element(p, p + 3) >= 254 ? 1 : 0;
    }
  }
  Measured found;
  const auto count = static_cast<double>(values.size());
  for (const double value : values) found.mean += value / count;
  double variance = 0;
  for (const double value : values) variance += (value - found.mean) * (value - found.mean) / count;
  found.deviation_by_mean = std::sqrt(variance) / found.mean;
  found.clipped = clipped / count;
  return found;
}

TEST(Light, ShowsTheFoldsOfACurtain) {
  Look look;
  look.color = {0.36, 0.55, 0.35};
  EXPECT_GE(measure(look).deviation_by_mean, 0.20);
}

TEST(Light, LeavesDarkWhiteAndRedClothReadable) {
  Look look;
  look.color = {0, 0, 0.5};  // navy
  EXPECT_GE(measure(look).deviation_by_mean, 0.20);
  EXPECT_GE(measure(look).mean, 0.06);
  look.color = {0, 0, 0};
  EXPECT_GE(measure(look).deviation_by_mean, 0.20);
  look.color = {1, 0, 0};
  EXPECT_GE(measure(look).deviation_by_mean, 0.15);
  EXPECT_EQ(measure(look).clipped, 0);
  look.color = {1, 1, 1};
  EXPECT_GE(measure(look).deviation_by_mean, 0.10);
  EXPECT_EQ(measure(look).clipped, 0);
}

/// Returns the CIE lightness of a pixel, 0 to 100.
double lightness(const std::uint8_t* p) {
  const double y = 0.2126 * to_linear(p[0]) + 0.7152 * to_linear(p[1]) + 0.0722 * to_linear(p[2]);
  return y > 0.008856 ? 116 * std::cbrt(y) - 16 : 903.3 * y;
}

TEST(Light, LetsNoClothVanishBeforeTheDefaultBackground) {
  // A level sheet seen from above fills the middle of the picture: the test scans its left edge, top to bottom.
  Mesh sheet = make_grid(4, 4);
  sheet.positions *= 0.6;
  for (const Rgb& color : {Rgb{1, 1, 1}, Rgb{0, 0, 0}, Rgb{0, 0, 0.5}, Rgb{1, 0, 0}}) {
    Look look;
    look.color = color;
    const Image image = draw(sheet, from_above(), look, {200, 200});
    for (int y = 45; y < 155; ++y) {
      EXPECT_GT(std::abs(lightness(image.at(45, y)) - lightness(image.at(30, y))), 4) << color.r << color.b << y;
    }
  }
}

TEST(Light, ComesFromAboveOnTheLeft) {
  // The same sheet, tilted by 40° towards the light's possible directions.
  const auto leaning = [](double x, double y) {
    Mesh mesh = make_grid(4, 4);
    const Vector3d normal = Vector3d(std::sin(0.7) * x, std::sin(0.7) * y, std::cos(0.7));
    const auto turned = rotation_from_z(normal).toRotationMatrix();
    mesh.positions *= turned.transpose();
    Look look;
    look.color = {0.5, 0.5, 0.5};
    return lightness(draw(mesh, from_above(), look, {101, 101}).at(50, 50));
  };
  EXPECT_GT(leaning(-1, 0), leaning(1, 0) + 15);
  EXPECT_GT(leaning(0, 1), leaning(0, -1) + 15);
}

TEST(Light, IsMultipliedByTheExposure) {
  const auto light = [](double exposure) {
    Look look;
    look.color = {0.3, 0.3, 0.3};
    look.exposure = exposure;
    return to_linear(draw(make_grid(4, 4), from_above(), look, {101, 101}).at(50, 50)[1]);
  };
  EXPECT_NEAR(light(2) / light(1), 2, 0.03);
  EXPECT_NEAR(light(0.5) / light(1), 0.5, 0.03);
}

// A level sheet receives the cosine of the light's zenith angle, from any side and for any camera.
TEST(Light, ComesFromWhereTheLookPlacesIt) {
  const auto light = [](double azimuth, double elevation) {
    Look look;
    look.color = {0.8, 0.8, 0.8};
    look.exposure = 0.3;  // below the shoulder of the tone curve
    look.shadows = look.ambient_occlusion = false;
    look.key_azimuth = azimuth;
    look.key_elevation = elevation;
    return to_linear(draw(make_grid(4, 4), from_above(), look, {101, 101}).at(50, 50)[1]);
  };
  const double dark = light(0, 0), bright = light(0, 60);
  for (const double azimuth : {-120.0, 45.0, 170.0}) EXPECT_NEAR(light(azimuth, 60), bright, 0.01) << azimuth;
  EXPECT_NEAR((light(0, 30) - dark) / (bright - dark), std::sin(std::numbers::pi / 6) / std::sin(std::numbers::pi / 3),
              0.05);
}

TEST(Light, CastsAShadowOnABackdrop) {
  Mesh sheet = make_grid(6, 6);
  sheet.positions *= 0.5;
  const View view{{0, -5, 2.5}, {0, 0, -0.6}, {0, 0, 1}, 34};
  Look look;
  look.backdrop = true;
  const Image with = draw(sheet, view, look, {200, 200});
  look.shadows = false;
  const Image without = draw(sheet, view, look, {200, 200});
  int darker = 0;
  for (int y = 130; y < 200; ++y) {
    for (int x = 0; x < 200; ++x) darker += with.at(x, y)[1] + 10 < without.at(x, y)[1] ? 1 : 0;
  }
  EXPECT_GT(darker, 200);
  // A scene with a ground gets no backdrop floor.
  const std::vector<Collider> ground{GroundShape{{0, 0, 1}, -1, 0.01}};
  Look plain = look;
  plain.backdrop = false;
  EXPECT_EQ(draw(sheet, view, look, {200, 200}, ground), draw(sheet, view, plain, {200, 200}, ground));
}

TEST(Light, OfABackdropCutsNothing) {
  const View view{{0, -5, 2.5}, {0, 0, -0.6}, {0, 0, 1}, 34};
  Look look;
  look.shadows = false;
  look.sphere_color = look.body_color = {1, 0, 0};
  Mesh sheet = make_grid(1, 1);
  sheet.positions.col(2).array() -= 6;
  const MeshShape body{.triangles = std::make_shared<std::vector<Triangle>>(sheet.triangles),
                       .positions = sheet.positions.rowwise() + Eigen::RowVector3d(1.5, 9, 0)};
  // Both are in view behind the target, below the level of the backdrop's floor there.
  const std::vector<Collider> behind{SphereShape{{-1.5, 9, -6}, 1}, body};
  const auto red_pixels = [&] {
    const Image image = draw(nothing(), view, look, {200, 200}, behind);
    int count = 0;
    for (int y = 0; y < 200; ++y) {
      for (int x = 0; x < 200; ++x) count += image.at(x, y)[0] > image.at(x, y)[1] + 60 ? 1 : 0;
    }
    return count;
  };
  const int all = red_pixels();
  EXPECT_GT(all, 500);
  look.backdrop = true;
  EXPECT_NEAR(red_pixels(), all, 0.02 * all);
}

TEST(Light, OfABackgroundHasNoBands) {
  // Dithered: over 4×4 pixels the mean matches the gradient to a quarter of a step; whole bytes would miss it by half a
  // step.
  Look look;
  look.background = Rgb{0.84, 0.84, 0.84};
  look.background_top = Rgb{0.80, 0.80, 0.80};
  const Image image = draw(nothing(), from_above(), look, {16, 400});
  for (int y = 0; y < 400; y += 4) {
    double mean = 0, exact = 0;
    for (int row = y; row < y + 4; ++row) {
      for (int x = 0; x < 4; ++x) mean += image.at(x, row)[1] / 16.0;
      exact += 255 * std::lerp(0.80, 0.84, (row + 0.5) / 400) / 4;
    }
    EXPECT_NEAR(mean, exact, 0.15) << y;
  }
}

TEST(Light, OnAFlatSheetIsThatOfItsFormula) {
  // Lambert's cosine of the key light, a wrapped fill light, sky and floor by the normal, and the tone curve's
  // shoulder: from the eye's direction sheen and highlight are below one byte.
  const Array3d key(1.02, 0.99, 0.93), sky(0.34, 0.36, 0.40), floor(0.20, 0.19, 0.18), fill(0.10, 0.11, 0.13);
  const double facing_key = 0.5 / Vector3d(-0.75, 0.8, 0.5).norm(), facing_fill = 0.5 / Vector3d(0.8, 0.15, 0.5).norm();
  for (const double gray : {0.1, 0.3, 0.5}) {
    const double albedo = to_linear(static_cast<std::uint8_t>(std::lround(255 * gray)));
    Look look;
    look.color = {std::lround(255 * gray) / 255.0, std::lround(255 * gray) / 255.0, std::lround(255 * gray) / 255.0};
    const Image image = draw(make_grid(4, 4), from_above(), look, {101, 101});
    const Array3d ambient = 0.5 * (sky + floor);  // up is in the sheet's plane
    const Array3d light = albedo * (key * facing_key + ambient + fill * (facing_fill + 0.4) / 1.4);
    for (int channel = 0; channel < 3; ++channel) {
      EXPECT_NEAR(to_linear(image.at(50, 50)[channel]), light[channel], 0.015 + 0.02 * light[channel]) << gray;
    }
  }
}

TEST(Light, ShinesThroughThinCloth) {
  // Seen against the light: tilted so that the key light falls on its back at a sufficient angle.
  Mesh sheet = make_grid(2, 2);
  const Eigen::AngleAxisd lean(1.25, Vector3d(0.8, 0.75, 0).normalized());
  sheet.positions = 0.5 * sheet.positions * lean.toRotationMatrix().transpose();
  Look felt, cotton;
  felt.color = cotton.color = {0.8, 0.8, 0.8};
  felt.translucency = 0;
  cotton.translucency = 0.5;
  const int dark = draw(sheet, from_above(), felt, {101, 101}).at(50, 50)[1];
  const int bright = draw(sheet, from_above(), cotton, {101, 101}).at(50, 50)[1];
  EXPECT_GT(bright, dark + 20);
}

TEST(Light, IsSmoothAcrossASeamOfTheTexturesCoordinates) {
  Mesh whole = make_grid(12, 12);
  whole.positions.col(2) = 0.3 * (4 * whole.positions.col(0)).array().sin();
  Mesh cut = whole;
  for (std::size_t t = 0; t < cut.triangles.size(); ++t) {
    const bool left = whole.positions(whole.triangles[t][0], 0) + whole.positions(whole.triangles[t][1], 0) +
                          whole.positions(whole.triangles[t][2], 0) <
                      0;
    for (std::size_t corner = 0; left && corner < 3; ++corner) cut.uvs[3 * t + corner][0] += 0.5F;
  }
  Look look;
  EXPECT_EQ(draw(cut, from_above(), look, {160, 160}), draw(whole, from_above(), look, {160, 160}));
}

TEST(Light, SwitchedOffChangesNothingWhereThereIsNothingToHide) {
  Look off;
  off.shadows = off.ambient_occlusion = false;
  off.translucency = 0;
  Look on;
  on.thickness = off.thickness = 0;  // light shines through the far side of a hem
  // A sheet that bulges towards the camera and the light: no part is occluded.
  Mesh bulge = make_grid(16, 16);
  for (Eigen::Index i = 0; i < bulge.positions.rows(); ++i) {
    bulge.positions(i, 2) = -0.05 * bulge.positions.row(i).head<2>().squaredNorm();
  }
  EXPECT_EQ(draw(bulge, from_above(), on, {160, 160}), draw(bulge, from_above(), off, {160, 160}));
}

}  // namespace
}  // namespace drape::test
