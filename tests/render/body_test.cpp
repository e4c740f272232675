// Bodies in pictures: position, smoothness, and shadows.

#include <gtest/gtest.h>

#include <cmath>

#include "render/draw_obstacles.hpp"
#include "tests/render/drawing.hpp"

namespace drape::test {
namespace {

using Eigen::Vector3d;

/// Makes the square [-half, half]² at a height.
MeshShape plate(double half, double height) {
  Mesh mesh = make_grid(1, 1);
  mesh.positions *= half;
  mesh.positions.col(2).array() += height;
  return {.triangles = std::make_shared<std::vector<Triangle>>(mesh.triangles), .positions = mesh.positions};
}

/// Makes a band of 2·segments triangles around the z axis.
Mesh tube(int segments) {
  Mesh mesh;
  mesh.positions.resize(Eigen::Index{2} * segments, 3);
  for (int k = 0; k < segments; ++k) {
    const double angle = 2 * 3.14159265358979323846 * k / segments;
    for (const int end : {0, 1}) mesh.positions.row(2 * k + end) << std::cos(angle), std::sin(angle), end;
    const int a = 2 * k, b = 2 * ((k + 1) % segments);
    mesh.triangles.push_back({a, b, b + 1});
    mesh.triangles.push_back({a, b + 1, a + 1});
  }
  return mesh;
}

int brightness(const Image& image, int x, int y) {
  const std::size_t at =
      3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x));
  return image.pixels[at] + image.pixels[at + 1] + image.pixels[at + 2];
}

Look flat_look() {
  Look look;
  look.background = Rgb{0, 0, 0};
  look.body_color = {1, 1, 1};
  return look;
}

TEST(BodyPicture, CoversWhatItCovers) {
  // Half of the picture's height, in the middle.
  const Image image = draw(nothing(), from_above(), flat_look(), {100, 100}, {plate(0.5, 0)});
  for (int y = 0; y < 100; ++y) {
    for (int x = 0; x < 100; ++x) {
      const bool inside = std::abs(x - 49.5) < 23 && std::abs(y - 49.5) < 23;
      const bool outside = std::abs(x - 49.5) > 27 || std::abs(y - 49.5) > 27;
      if (inside) {
        EXPECT_GT(brightness(image, x, y), 300);
      }
      if (outside) {
        EXPECT_EQ(brightness(image, x, y), 0);
      }
    }
  }
}

TEST(BodyPicture, HidesTheClothBehindItAndIsHiddenByTheOneOnIt) {
  Look look = flat_look();
  look.body_color = {1, 0, 0};
  look.color = {0, 0, 1};
  look.translucency = 0;
  const auto red_beats_blue = [&](double height, double thickness) {
    MeshShape body = plate(0.5, height);
    body.thickness = thickness;
    const Image image = draw(make_grid(4, 4), from_above(), look, {40, 40}, {body});
    const std::size_t middle = std::size_t{3} * (20 * 40 + 20);
    return image.pixels[middle] > image.pixels[middle + 2];
  };
  EXPECT_TRUE(red_beats_blue(0.1, 0.02));
  EXPECT_FALSE(red_beats_blue(-0.1, 0.02));
  EXPECT_FALSE(red_beats_blue(0.01, 0.02)) << "a cloth that dips into the layer";
}

TEST(BodyPicture, IsWholeWhereItsLayerIsThickerThanTheScene) {
  Mesh cloth = make_grid(2, 2);
  cloth.positions *= 0.1;
  MeshShape body = plate(0.5, 0);
  body.thickness = 0.3;
  const Image image = draw(cloth, from_above(), flat_look(), {100, 100}, {body});
  for (const int x : {30, 70}) EXPECT_GT(brightness(image, x, 50), 300) << x;
}

TEST(BodyPicture, ThrowsAShadowOnTheClothAndTakesOne) {
  Look look = flat_look();
  look.ambient_occlusion = false;
  const auto sum = [](const Image& image) {
    double all = 0;
    for (const std::uint8_t byte : image.pixels) all += byte;
    return all;
  };
  // A plate outside the camera's view, between the cloth and the light, which comes from the upper left and the camera.
  const MeshShape beside = plate(1, 1.5);
  MeshShape moved = beside;
  moved.positions.rowwise() += Eigen::RowVector3d(-2.25, 2.4, 0);  // along the light's direction
  Look dark = look;
  dark.shadows = false;
  const Mesh cloth = make_grid(8, 8);
  EXPECT_LT(sum(draw(cloth, from_above(), look, {60, 60}, {moved})),
            sum(draw(cloth, from_above(), dark, {60, 60}, {moved})) * 0.995);
  Mesh above = make_grid(8, 8);
  above.positions.rowwise() += Eigen::RowVector3d(-2.25, 2.4, 1.5);
  EXPECT_LT(sum(draw(above, from_above(), look, {60, 60}, {plate(1, 0)})),
            sum(draw(above, from_above(), dark, {60, 60}, {plate(1, 0)})) * 0.995);
}

TEST(CreasedMesh, PartsVerticesAtCreasesOnly) {
  const Mesh round = tube(24), square = tube(4);
  EXPECT_EQ(CreasedMesh(round.triangles, round.positions).sources.size(), 48U);
  // Each of the eight vertices of a square tube has two normals.
  EXPECT_EQ(CreasedMesh(square.triangles, square.positions).sources.size(), 16U);
}

TEST(BodyFraming, HasAllOfABodyInView) {
  const Camera camera{.azimuth = -90, .elevation = 0};
  Framing framing(camera, 1);
  framing.add(make_grid(2, 2).positions);
  framing.add(plate(5, 0));
  const View view = framing.view();
  for (const double x : {-5.0, 5.0}) {
    const Eigen::Vector4d clip =
        view.projection_matrix(1, {1, 100}) * view.view_matrix() * Eigen::Vector4d(x, -5, 0, 1);
    EXPECT_LT(std::abs(clip[0] / clip[3]), 1);
  }
}

}  // namespace
}  // namespace drape::test
