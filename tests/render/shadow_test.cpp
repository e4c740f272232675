#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <optional>

#include "render/shadows.hpp"
#include "render/shot.hpp"
#include "tests/render/drawing.hpp"

// Drawn shadows compared with rays traced through the mesh.

namespace drape::test {
namespace {

using Eigen::Vector3d;

/// Returns a look with nothing but shadows, on white cloth.
Look only_shadows(bool shadows = true) {
  Look look;
  look.color = {1, 1, 1};
  look.background = Rgb{0, 0, 0};
  look.samples = 1;
  look.shadows = shadows;
  look.ambient_occlusion = false;
  look.translucency = 0;
  return look;
}

/// Makes a wavy sheet, with a small one above a part of it.
Mesh two_layers() {
  Mesh mesh = make_grid(30, 30);
  for (Eigen::Index i = 0; i < mesh.positions.rows(); ++i) {
    const double x = mesh.positions(i, 0), y = mesh.positions(i, 1);
    mesh.positions(i, 2) = 0.12 * std::sin(5 * x + y) * std::cos(3 * y);
  }
  const Mesh small = make_grid(6, 6);
  const int first = static_cast<int>(mesh.positions.rows());
  Vertices all(first + small.positions.rows(), 3);
  all << mesh.positions, (0.35 * small.positions).rowwise() + Eigen::RowVector3d(-0.1, 0.15, 0.55);
  mesh.positions = all;
  for (const Triangle& t : small.triangles) mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  mesh.uvs.clear();
  return mesh;
}

struct Hit {
  double distance;
  Vector3d normal;
};

/// Returns the first triangle that a ray hits beyond some distance (Möller and Trumbore 1997).
std::optional<Hit> meet(const Mesh& mesh, const Vector3d& from, const Vector3d& direction, double beyond) {
  std::optional<Hit> first;
  for (const Triangle& t : mesh.triangles) {
    const Vector3d a = mesh.positions.row(t[0]), ab = mesh.positions.row(t[1]).transpose() - a,
                   ac = mesh.positions.row(t[2]).transpose() - a;
    const Vector3d p = direction.cross(ac);
    const double determinant = ab.dot(p);
    if (std::abs(determinant) < 1e-14) continue;
    const Vector3d offset = from - a, q = offset.cross(ab);
    const double u = offset.dot(p) / determinant, v = direction.dot(q) / determinant;
    const double distance = ac.dot(q) / determinant;
    if (u < 0 || v < 0 || u + v > 1 || distance < beyond) continue;
    if (!first || distance < first->distance) first = Hit{distance, ab.cross(ac).normalized()};
  }
  return first;
}

double light_at(const Image& image, int x, int y) { return to_linear(image.at(x, y)[1]); }

TEST(Shadow, LiesWhereRaysToTheLightMeetTheCloth) {
  const Mesh mesh = two_layers();
  View view{{1.5, -3, 4}, {0, 0, 0}, {0, 0, 1}, 34};
  const Eigen::Vector2i size{160, 160};
  const Image with = draw(mesh, view, only_shadows(), size), without = draw(mesh, view, only_shadows(false), size);
  Frame frame;
  frame.positions = mesh.positions;
  const Shot shot(frame, view, 1);
  const Vector3d light = shot.key_direction.cast<double>().normalized();
  const Vector3d side = light.unitOrthogonal(), other = light.cross(side);
  const Eigen::Matrix3d axes = view.axes();
  const double half = std::tan(view.field_of_view * std::numbers::pi / 360), edge = 0.02, contact = 0.05;
  int dark = 0, bright = 0, agreed = 0;
  for (int y = 1; y < size.y(); y += 3) {
    for (int x = 1; x < size.x(); x += 3) {
      const double right = half * (2 * (x + 0.5) / size.x() - 1), up = half * (1 - 2 * (y + 0.5) / size.y());
      const Vector3d ray = (axes.transpose() * Vector3d(right, up, -1)).normalized();
      const auto hit = meet(mesh, view.position, ray, 0);
      if (!hit) continue;
      const Vector3d normal = hit->normal.dot(ray) < 0 ? hit->normal : Vector3d(-hit->normal);
      if (normal.dot(light) < 0.25) continue;
      const Vector3d point = view.position + hit->distance * ray + 1e-3 * normal;
      int hidden = 0;
      for (const auto& [a, b] : {std::pair(0, 0), {1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
        hidden += meet(mesh, point + edge * (a * side + b * other), light, contact) ? 1 : 0;
      }
      const double left = light_at(with, x, y) / light_at(without, x, y);
      if (hidden == 5) agreed += left < 0.55 ? 1 : 0, ++dark;
      if (hidden == 0) agreed += left > 0.97 ? 1 : 0, ++bright;
    }
  }
  EXPECT_GT(dark, 40);
  EXPECT_GT(bright, 400);
  EXPECT_GE(agreed, 0.985 * (dark + bright)) << "of " << dark << " in the shadow and " << bright << " in the light";
}

TEST(Shadow, IsNotThereOnAFlatSheetHoweverItLies) {
  const Mesh flat = make_grid(15, 15);
  for (int turn = 0; turn < 14; ++turn) {
    Mesh mesh = flat;
    const Eigen::AngleAxisd lean(0.22 * turn - 1.4, Vector3d(std::cos(turn), std::sin(turn), 0));
    mesh.positions = flat.positions * lean.toRotationMatrix().transpose();
    Look all = only_shadows();
    all.ambient_occlusion = true;
    const Image plain = draw(mesh, from_above(), only_shadows(false), {160, 160});
    EXPECT_EQ(draw(mesh, from_above(), only_shadows(), {160, 160}), plain) << "leaning " << 0.22 * turn - 1.4;
    EXPECT_EQ(draw(mesh, from_above(), all, {160, 160}), plain) << "leaning " << 0.22 * turn - 1.4;
  }
}

TEST(Shadow, IsNotOfASurfaceOnItself) {
  // A speck above one corner makes the whole sheet be drawn with shadows; far from the speck there must be none.
  const Mesh flat = make_grid(1, 1);
  Frame frame;
  frame.positions = flat.positions;
  const Vector3d light = Shot(frame, from_above(), 1).key_direction.cast<double>().normalized();
  for (int turn = 0; turn < 14; ++turn) {
    const Eigen::AngleAxisd lean(0.15 * turn - 1, Vector3d(std::cos(turn), std::sin(turn), 0));
    Mesh mesh = flat;
    mesh.positions.conservativeResize(7, 3);
    mesh.positions.topRows<4>() = flat.positions * lean.toRotationMatrix().transpose();
    const Vector3d corner = mesh.positions.row(0);
    for (int k = 0; k < 3; ++k) mesh.positions.row(4 + k) = 0.8 * corner + 0.4 * light + 0.15 * Vector3d::Unit(k);
    mesh.triangles.push_back({4, 5, 6});
    mesh.uvs.clear();
    const Eigen::Vector2d around(80 * (1 + corner.x()), 80 * (1 - corner.y()));
    const Image with = draw(mesh, from_above(), only_shadows(), {160, 160});
    const Image without = draw(mesh, from_above(), only_shadows(false), {160, 160});
    int near = 0, far = 0;
    for (int y = 0; y < 160; ++y) {
      for (int x = 0; x < 160; ++x) {
        const bool darker = with.at(x, y)[1] < without.at(x, y)[1];
        ((Eigen::Vector2d(x, y) - around).norm() < 65 ? near : far) += darker ? 1 : 0;
      }
    }
    const bool faces_light = (lean * Vector3d::UnitZ()).dot(light) > 0.2;
    EXPECT_TRUE(near > 0 || !faces_light) << "the speck casts no shadow, leaning " << lean.angle();
    EXPECT_EQ(far, 0) << "leaning " << lean.angle();
  }
}

TEST(Shadow, OfAClothTakesTheSpheresHighlight) {
  Mesh roof = make_grid(8, 8);
  const std::vector<Collider> ball{SphereShape{{0, 0, 0}, 0.4}};
  const View view{{0, -4, 1.2}, {0, 0, 0.2}, {0, 0, 1}, 34};
  Frame frame;
  frame.positions = roof.positions;
  const Vector3d light = Shot(frame, view, 1).key_direction.cast<double>();
  roof.positions = (0.6 * roof.positions).rowwise() + 1.2 * light.transpose();
  Look look;
  const Image shaded = draw(roof, view, look, {200, 200}, ball);
  const Image open = draw(nothing(), view, look, {200, 200}, ball);
  int brightest = 0, there = 0;
  for (int y = 90; y < 150; ++y) {
    for (int x = 70; x < 130; ++x) {
      if (open.at(x, y)[1] > brightest) brightest = open.at(x, y)[1], there = shaded.at(x, y)[1];
    }
  }
  EXPECT_GT(brightest, 150);
  EXPECT_LT(there, brightest - 60);
}

TEST(Shadow, OfASphereFallsOnTheCloth) {
  const Mesh sheet = make_grid(10, 10);
  const View view = from_above();
  Frame frame;
  frame.positions = sheet.positions;
  const Vector3d light = Shot(frame, view, 1).key_direction.cast<double>().normalized();
  // A ball beside the picture, with its shadow in the middle.
  const Vector3d center = 0.9 * light;
  const std::vector<Collider> ball{SphereShape{center, 0.15}};
  const Image with = draw(sheet, view, only_shadows(), {160, 160}, ball);
  const Image without = draw(sheet, view, only_shadows(false), {160, 160}, ball);
  EXPECT_LT(light_at(with, 80, 80), 0.6 * light_at(without, 80, 80));
  EXPECT_EQ(with.at(20, 140)[1], without.at(20, 140)[1]);
}

/// Makes a sheet with a ridge along x, on a mesh that is rotated against it: the surface, and so its picture, is
/// constant along the ridge.
Mesh ridge(double height) {
  Mesh mesh = make_grid(40, 40);
  const Eigen::Rotation2D<double> turn(0.35);
  for (Eigen::Index i = 0; i < mesh.positions.rows(); ++i) {
    const Eigen::Vector2d p = 1.6 * (turn * mesh.positions.row(i).head<2>().transpose());
    mesh.positions.row(i) << p.x(), p.y(), height * std::exp(-12 * p.y() * p.y());
  }
  return mesh;
}

/// Returns the largest standard deviation of a row's light: the roughness of a picture that should be constant along
/// rows.
double roughness(const Image& image) {
  double worst = 0;
  for (int y = image.height / 6; y < 5 * image.height / 6; ++y) {
    double sum = 0, squares = 0;
    int count = 0;
    for (int x = image.width / 4; x < 3 * image.width / 4; ++x, ++count) {
      const double light = image.at(x, y)[1];
      sum += light;
      squares += light * light;
    }
    worst = std::max(worst, std::sqrt(std::max(0.0, squares / count - sum * sum / count / count)));
  }
  return worst;
}

// Shadow edges are as smooth as the surface and do not follow the mesh.
TEST(Shadow, OfARidgeHasNoTeeth) {
  Look look = only_shadows();
  look.thickness = 0;
  // The light comes over the ridge at angles at which its far side begins to be, or is, in shadow.
  look.key_azimuth = 90;
  View view = from_above();
  view.position.z() = 500;  // far away, with the same picture: the highlight is constant along a row
  view.field_of_view = 2 * std::atan(1.0 / 500) * 180 / std::numbers::pi;
  for (const Eigen::Vector2i& size : {Eigen::Vector2i(240, 200), {1296, 1080}}) {
    for (const double elevation : {18.0, 25.0, 32.0, 45.0}) {
      look.key_elevation = elevation;
      for (const double height : {0.2, 0.35}) {
        EXPECT_LT(roughness(draw(ridge(height), view, look, size)), 10)  // 23 for an edge of one texel
            << elevation << " degrees, " << height << " m, " << size.y() << " rows";
      }
    }
  }
}

}  // namespace
}  // namespace drape::test
