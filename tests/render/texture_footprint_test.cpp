#include "render/draw_cloth.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include "tests/render/drawing.hpp"

namespace drape::test {
namespace {

constexpr double degree = 3.14159265358979323846 / 180;

Eigen::Matrix2d footprint(double length, double width, double angle) {
  return Eigen::Rotation2Dd(angle).toRotationMatrix() * Eigen::Vector2d(length, width).asDiagonal();
}

TEST(TextureFootprint, NeedsSamplesByItsStretch) {
  for (const double angle : {0.0, 0.7, 2.0}) {
    for (const double width : {2.0, 5.0, 40.0}) {
      const auto samples = [&](double stretch, int anisotropy) {
        return footprint_samples(footprint(stretch * width, width, angle), anisotropy);
      };
      EXPECT_EQ(samples(1.0, 4), 1);
      EXPECT_EQ(samples(1.5, 4), 1);
      EXPECT_EQ(samples(2.0, 4), 2);
      EXPECT_EQ(samples(3.9, 4), 3);
      EXPECT_EQ(samples(20.0, 4), 3);
      EXPECT_EQ(samples(20.0, 2), 2);
      EXPECT_EQ(samples(20.0, 16), 11);
      EXPECT_EQ(samples(20.0, 1), 1);
    }
  }
}

TEST(TextureFootprint, DependsOnNoRotationOfThePicture) {
  for (const double stretch : {1.2, 2.2, 5.0}) {
    const Eigen::Matrix2d change = footprint(3 * stretch, 3, 0.4);
    for (double angle = 0; angle < 6.3; angle += 0.3) {
      const Eigen::Matrix2d turned = change * Eigen::Rotation2Dd(angle).toRotationMatrix();
      EXPECT_EQ(footprint_samples(turned, 4), footprint_samples(change, 4)) << stretch << ", " << angle;
    }
  }
}

TEST(TextureFootprint, OfAMagnifiedTextureNeedsOneSample) {
  EXPECT_EQ(footprint_samples(footprint(0.9, 0.01, 0.3), 4), 1);
  EXPECT_EQ(footprint_samples(footprint(0, 0, 0), 4), 1);
}

/// Turns a square cloth about its horizontal axis by an angle away from the camera's plane.
Mesh turned_away(double angle) {
  Mesh mesh = make_grid(4, 4);
  mesh.positions.rowwise() -= mesh.positions.colwise().mean();
  mesh.positions *= 1 / mesh.positions.col(0).maxCoeff();
  mesh.positions =
      (mesh.positions * Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitX()).toRotationMatrix().transpose()).eval();
  return mesh;
}

// From far away a plane at an angle shortens by the angle's cosine, whatever its triangles are.
TEST(TextureFootprint, OfAPlaneFollowsItsAngle) {
  constexpr int texels = 2000, pixels = 100;
  View view = from_above();
  view.position *= 200;
  view.field_of_view /= 200;
  for (const auto& [angle, expected] : {std::pair{0.0, 1}, {40.0, 1}, {60.0, 2}, {70.0, 2}, {75.0, 3}, {85.0, 3}}) {
    const Mesh mesh = turned_away(angle * degree);
    std::vector<Eigen::Matrix2d> edges;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      Eigen::Matrix2d& edge = edges.emplace_back();
      for (int k = 0; k < 2; ++k) {
        for (std::size_t axis = 0; axis < 2; ++axis) {
          edge(static_cast<int>(axis), k) =
              texels * (double{mesh.uvs[3 * t + static_cast<std::size_t>(k) + 1][axis]} - mesh.uvs[3 * t][axis]);
        }
      }
    }
    const Frame frame{.positions = mesh.positions};
    const Shot shot(frame, view, 1);
    TextureFootprints footprints(edges, 4);
    for (const int samples : footprints.count(shot, mesh.positions, mesh.triangles, {pixels, pixels})) {
      EXPECT_EQ(samples, expected) << angle;
    }
  }
}

/// A grey image as a file, removed with the object.
class GreyImage {
 public:
  template <class Value>  // of a column, 0 to 255
  GreyImage(int width, int height, const Value& value)
      : path_(std::filesystem::path(testing::TempDir()) / (std::to_string(getpid()) + "grey.pgm")) {
    std::ofstream file(path_, std::ios::binary);
    file << "P5\n" << width << ' ' << height << "\n255\n";
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) file.put(static_cast<char>(value(x)));
    }
  }
  GreyImage(const GreyImage&) = delete;
  GreyImage& operator=(const GreyImage&) = delete;
  ~GreyImage() { std::filesystem::remove(path_); }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

Image textured(const GreyImage& texture, double angle, int anisotropy) {
  Look look;
  look.texture = texture.path();
  look.anisotropy = anisotropy;
  look.thickness = 0;
  look.shadows = look.ambient_occlusion = false;
  return draw(turned_away(angle * degree), from_above(), look, {200, 200});
}

/// Returns the mean difference of neighbouring pixels in the middle row.
double contrast(const Image& image) {
  double sum = 0;
  for (int x = 60; x < 140; ++x) sum += std::abs(image.at(x + 1, 100)[1] - image.at(x, 100)[1]);
  return sum / 80;
}

// Upright stripes of 2.5 pixels on a cloth that is turned back: a single sample is as wide as the footprint is long.
TEST(Anisotropy, KeepsStripesSharpThatAreSeenAslant) {
  const GreyImage stripes(1024, 1024, [](int x) { return x / 12 % 2 == 0 ? 40 : 220; });
  const double blurred = contrast(textured(stripes, 76, 1)), sharp = contrast(textured(stripes, 76, 4));
  EXPECT_GT(sharp, 2 * blurred);
  EXPECT_GT(sharp, 0.4 * contrast(textured(stripes, 0, 1)));
}

TEST(Anisotropy, ChangesNoPixelOfAClothThatFacesTheCamera) {
  const GreyImage stripes(1024, 1024, [](int x) { return x / 12 % 2 == 0 ? 40 : 220; });
  EXPECT_EQ(textured(stripes, 0, 4).pixels, textured(stripes, 0, 1).pixels);
}

// Samples lie symmetrically around the pixel, so they keep a ramp at every angle.
TEST(Anisotropy, KeepsARamp) {
  const GreyImage ramp(1024, 1024, [](int x) { return 60 + x / 8; });
  for (const double angle : {50.0, 65.0, 80.0}) {
    const Image one = textured(ramp, angle, 1), several = textured(ramp, angle, 8);
    int covered = 0;
    for (int y = 80; y < 120; ++y) {
      for (int x = 40; x < 160; ++x) {
        covered += one.at(x, y)[1] < 150 ? 1 : 0;
        EXPECT_NEAR(one.at(x, y)[1], several.at(x, y)[1], 2) << angle << ": " << x << ", " << y;
      }
    }
    EXPECT_GT(covered, 100) << angle;
  }
}

}  // namespace
}  // namespace drape::test
