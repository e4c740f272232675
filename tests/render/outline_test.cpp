// Smooth outlines: each pixel shows as much of the background as lies beyond the outline.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "tests/render/drawing.hpp"
#include "tests/support/closed_meshes.hpp"

namespace drape::test {
namespace {

using Eigen::Vector2d;
using Polygon = std::vector<Vector2d>;

constexpr int width = 90, height = 80;

/// Light lost to rounding in two sRGB bytes.
constexpr double rounding = 0.006;

Look plain_look() {
  Look look;
  look.shadows = look.ambient_occlusion = false;
  look.thickness = 0;
  look.color = look.body_color = look.sphere_color = {0.5, 0.5, 0.5};
  return look;
}

/// Returns the covered part of each pixel, rows from the top: what a black and a white background leave to each other.
Eigen::MatrixXd coverage(const Mesh& mesh, const std::vector<Collider>& colliders, Look look = plain_look()) {
  look.background = Rgb{0, 0, 0};
  const Image dark = draw(mesh, from_above(), look, {width, height}, colliders);
  look.background = Rgb{1, 1, 1};
  const Image bright = draw(mesh, from_above(), look, {width, height}, colliders);
  Eigen::MatrixXd covered(height, width);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) covered(y, x) = 1 - to_linear(bright.at(x, y)[1]) + to_linear(dark.at(x, y)[1]);
  }
  return covered;
}

/// Returns the place in the picture, from the upper left corner, of a point [pixels].
Vector2d in_picture(const Eigen::Vector3d& p) {
  const double nearer = 5 / (5 - p.z());
  return {width / 2.0 + height / 2.0 * nearer * p.x(), height / 2.0 - height / 2.0 * nearer * p.y()};
}

/// Returns a polygon's part where x (axis 0) or y (axis 1) times `sign` is at most `limit` (Sutherland and Hodgman).
Polygon cut(const Polygon& polygon, int axis, double sign, double limit) {
  Polygon kept;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vector2d &p = polygon[k], &q = polygon[(k + 1) % polygon.size()];
    const double from = sign * p[axis] - limit, to = sign * q[axis] - limit;
    if (from <= 0) kept.push_back(p);
    if ((from < 0 && to > 0) || (from > 0 && to < 0)) kept.emplace_back(p + from / (from - to) * (q - p));
  }
  return kept;
}

double area(const Polygon& polygon) {
  double twice = 0;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vector2d &p = polygon[k], &q = polygon[(k + 1) % polygon.size()];
    twice += p.x() * q.y() - p.y() * q.x();
  }
  return std::abs(twice) / 2;
}

double part_inside(const Polygon& polygon, int x, int y) {
  return area(cut(cut(cut(cut(polygon, 0, 1, x + 1), 0, -1, -x), 1, 1, y + 1), 1, -1, -y));
}

/// Compares a picture with a polygon. Near its corners a pixel may be wrong. Elsewhere the ends of the drawn lines are
/// rounded to 1/256 pixel.
void expect_covers(const Eigen::MatrixXd& covered, const Polygon& polygon) {
  double sum = 0;
  int crossed = 0;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const Vector2d middle(x + 0.5, y + 0.5);
      const bool at_corner =
          std::ranges::any_of(polygon, [&](const Vector2d& corner) { return (corner - middle).norm() < 1.8; });
      const double exact = part_inside(polygon, x, y), error = std::abs(covered(y, x) - exact);
      if (at_corner) continue;
      EXPECT_LT(error, 0.01 + rounding) << x << ", " << y << ": " << covered(y, x) << " instead of " << exact;
      if (exact == 0 || exact == 1) continue;
      ++crossed;
      sum += error;
    }
  }
  EXPECT_GT(crossed, 100);
  EXPECT_LT(sum / crossed, 0.004);
  EXPECT_NEAR(covered.sum(), area(polygon), 2e-3 * area(polygon));
}

/// Returns the corners of the square [-half, half]², turned.
std::vector<Eigen::Vector3d> turned_square(double half, double degrees) {
  std::vector<Eigen::Vector3d> corners;
  for (int k = 0; k < 4; ++k) {
    const double angle = (degrees + 45 + 90 * k) * std::numbers::pi / 180;
    corners.emplace_back(std::sqrt(2) * half * std::cos(angle), std::sqrt(2) * half * std::sin(angle), 0);
  }
  return corners;
}

Mesh turned_cloth(double half, double degrees, int cells = 6) {
  Mesh mesh = make_grid(cells, cells);
  mesh.positions *= half;
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(degrees * std::numbers::pi / 180, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  mesh.positions *= turn.transpose();
  return mesh;
}

TEST(Outline, CoversTheExactPartOfEachPixel) {
  for (const double degrees : {0.0, 1.0, 7.0, 20.0, 33.0, 45.0}) {
    SCOPED_TRACE(degrees);
    Polygon polygon;
    for (const Eigen::Vector3d& corner : turned_square(0.61, degrees)) polygon.push_back(in_picture(corner));
    expect_covers(coverage(turned_cloth(0.61, degrees), {}), polygon);
  }
}

TEST(Outline, OfASphereIsItsRim) {
  const double radius = 0.7, distance = 5;
  const double rim = std::tan(std::asin(radius / distance)) * distance * height / 2;
  Polygon circle;
  for (int k = 0; k < 720; ++k) {
    const double angle = k * std::numbers::pi / 360;
    circle.emplace_back(width / 2.0 + rim * std::cos(angle), height / 2.0 + rim * std::sin(angle));
  }
  const Eigen::MatrixXd covered = coverage(nothing(), {SphereShape{{0, 0, 0}, radius}});
  EXPECT_NEAR(covered.sum(), area(circle), 1e-3 * area(circle));
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) EXPECT_NEAR(covered(y, x), part_inside(circle, x, y), 0.05);
  }
}

MeshShape shape(const Mesh& mesh) {
  return {.triangles = std::make_shared<std::vector<Triangle>>(mesh.triangles), .positions = mesh.positions};
}

TEST(Outline, OfACurvedBodyIsWhereItTurnsAway) {
  const double radius = 0.7, distance = 5;
  const double rim = std::tan(std::asin(radius / distance)) * distance * height / 2;
  const Eigen::MatrixXd covered = coverage(nothing(), {shape(ball(40, radius))});
  EXPECT_NEAR(covered.sum(), std::numbers::pi * rim * rim, 3e-3 * std::numbers::pi * rim * rim);
  int between = 0;
  for (Eigen::Index k = 0; k < covered.size(); ++k) {
    const double part = covered.data()[k];
    between += part > 0.1 && part < 0.9 ? 1 : 0;
  }
  EXPECT_GT(between, 3.2 * rim);  // of 8 rim crossed pixels, as many as have an even share
}

/// Two faces of a body that meet at a slanting crease in the middle of the picture.
TEST(Outline, SmoothsACreaseBetweenTwoFaces) {
  constexpr double slope = 0.21;
  Mesh roof;
  roof.positions.resize(6, 3);
  roof.positions << -1, -1, -0.8, 1, -1, -0.8, -1, -slope, 0, 1, slope, 0, -1, 1, -0.8, 1, 1, -0.8;
  roof.triangles = {{0, 1, 3}, {0, 3, 2}, {2, 3, 5}, {2, 5, 4}};
  Look look = plain_look();
  look.background = Rgb{0, 0, 0};
  const Image image = draw(nothing(), from_above(), look, {width, height}, {shape(roof)});
  for (int x = 10; x < width - 10; ++x) {
    const double crease = in_picture({0, slope * (x + 0.5 - width / 2.0) / (height / 2.0), 0}).y();
    const auto light = [&](int y) { return to_linear(image.at(x, y)[1]); };
    const int row = static_cast<int>(crease);
    // Over three pixels each face is even, so the sum of light tells how much is in front of the crease.
    const double above = light(row - 2), below = light(row + 2);
    ASSERT_GT(std::abs(above - below), 0.05);
    const double sum = light(row - 1) + light(row) + light(row + 1);
    EXPECT_NEAR((sum - 3 * below) / (above - below), crease - (row - 1), 0.13) << x;
  }
}

/// Returns one mesh of two, the second at a height.
Mesh together(const Mesh& first, const Mesh& second, double at_height) {
  Mesh both = first;
  both.uvs.clear();
  const auto count = static_cast<int>(first.positions.rows());
  both.positions.conservativeResize(count + second.positions.rows(), 3);
  both.positions.bottomRows(second.positions.rows()) = second.positions;
  both.positions.bottomRows(second.positions.rows()).col(2).array() += at_height;
  for (const Triangle& t : second.triangles) both.triangles.push_back({t[0] + count, t[1] + count, t[2] + count});
  return both;
}

TEST(Outline, DoesNotShowThroughWhatIsInFront) {
  const Mesh front = turned_cloth(0.8, 10), hidden = turned_cloth(0.5, 25);
  Mesh alone = front;
  alone.uvs.clear();
  Look look = plain_look();
  look.background = Rgb{1, 0, 0};
  look.mesh_lines = true;  // what blends pixels of the cloth would smear its lines
  look.line_width = 2;
  for (const double depth : {-0.02, -0.3}) {
    // Twice the cloth has another range of depths, so bits need not agree.
    const Image expected = draw(alone, from_above(), look, {width, height});
    const Image found = draw(together(front, hidden, depth), from_above(), look, {width, height});
    for (std::size_t k = 0; k < expected.pixels.size(); ++k) {
      ASSERT_NEAR(expected.pixels[k], found.pixels[k], 1) << depth << ", byte " << k;
    }
  }
}

TEST(Outline, OfClothInFrontOfAnotherIsSmoothToo) {
  const Mesh behind = turned_cloth(0.9, 0), front = turned_cloth(0.4, 20);
  Mesh both = together(behind, front, 0.1);
  Look look = plain_look();
  look.background = Rgb{0, 0, 0};
  look.cloths = {{.first_triangle = 0, .color = {1, 1, 1}},
                 {.first_triangle = static_cast<int>(behind.triangles.size()), .color = {0, 0, 0}}};
  const Image image = draw(both, from_above(), look, {width, height});
  Polygon polygon;
  for (Eigen::Vector3d corner : turned_square(0.4, 20)) {
    corner.z() = 0.1;
    polygon.push_back(in_picture(corner));
  }
  const double white = to_linear(image.at(width / 2, 12)[1]), black = to_linear(image.at(width / 2, height / 2)[1]);
  double covered = 0;
  for (int y = 15; y < height - 15; ++y) {
    for (int x = 20; x < width - 20; ++x) covered += (white - to_linear(image.at(x, y)[1])) / (white - black);
  }
  EXPECT_NEAR(covered, area(polygon), 0.01 * area(polygon));
}

/// A hem narrower than a pixel and a half would make the border uneven; from near, it is part of the outline.
TEST(Outline, IncludesTheHemWhereItIsResolved) {
  Look look = plain_look();
  const Mesh cloth = turned_cloth(0.6, 15, 2);
  const double plain = coverage(cloth, {}, look).sum();
  look.thickness = 0.02;  // 0.8 pixels
  EXPECT_EQ(coverage(cloth, {}, look).sum(), plain);
  look.thickness = 0.06;
  Polygon polygon;
  for (const Eigen::Vector3d& corner : turned_square(0.6 + 0.03, 15)) polygon.push_back(in_picture(corner));
  // The tube's radius is half the thickness; it rounds the corners.
  EXPECT_NEAR(coverage(cloth, {}, look).sum(), area(polygon), 0.01 * area(polygon));
}

}  // namespace
}  // namespace drape::test
