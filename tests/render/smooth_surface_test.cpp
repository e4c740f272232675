#include "render/smooth_surface.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>

#include "tests/render/drawing.hpp"

namespace drape::test {
namespace {

using Eigen::Vector3d;

Vector3d place_in_parent(const Mesh& mesh, const SmoothSurface::Piece& piece, std::size_t corner) {
  Vector3d sum = Vector3d::Zero();
  for (std::size_t k = 0; k < 3; ++k) {
    sum += double{piece.weights[corner][k]} *
           mesh.positions.row(mesh.triangles[static_cast<std::size_t>(piece.parent)][k]).transpose();
  }
  return sum;
}

TEST(SmoothSurface, OfAFlatGridIsTheGrid) {
  Mesh mesh = make_grid(7, 5);
  const Eigen::AngleAxisd lean(0.7, Vector3d(1, 2, 0.5).normalized());
  mesh.positions = (mesh.positions * lean.toRotationMatrix().transpose()).rowwise() + Eigen::RowVector3d(3, 1, -2);
  for (const int levels : {0, 1, 2}) {
    const SmoothSurface surface(mesh.triangles, levels);
    const Vertices drawn = surface.positions(mesh.positions);
    EXPECT_EQ(surface.pieces().size(), mesh.triangles.size() << (2 * levels));
    for (const auto& piece : surface.pieces()) {
      for (std::size_t c = 0; c < 3; ++c) {
        const Vector3d there = drawn.row(piece.corners[c]);
        EXPECT_LT((there - place_in_parent(mesh, piece, c)).norm(), 1e-6) << levels;
      }
    }
  }
}

/// Makes the upper half of the unit sphere from a grid.
Mesh dome(int cells) {
  Mesh mesh = make_grid(cells, cells);
  for (Eigen::Index i = 0; i < mesh.positions.rows(); ++i) {
    const double x = 0.7 * mesh.positions(i, 0), y = 0.7 * mesh.positions(i, 1);
    mesh.positions.row(i) << x, y, std::sqrt(1 - x * x - y * y);
  }
  return mesh;
}

double largest_deviation(int cells) {
  const Mesh mesh = dome(cells);
  const SmoothSurface surface(mesh.triangles, 2);
  const Vertices drawn = surface.positions(mesh.positions);
  double worst = 0;
  for (const auto& x : drawn.rowwise()) {
    if (std::max(std::abs(x[0]), std::abs(x[1])) < 0.4) worst = std::max(worst, std::abs(x.norm() - 1));
  }
  return worst;
}

// Extra distance that a sphere needs to keep the drawn surface outside: negligible.
TEST(SmoothSurface, OfADomeKeepsItsRadius) {
  EXPECT_LT(largest_deviation(14), 5e-4);  // edges of a tenth: plain triangles sink in by 1.2e-3
  EXPECT_LT(largest_deviation(28), largest_deviation(14) / 8);
}

TEST(SmoothSurface, KeepsTheCornersOfTheCloth) {
  Mesh mesh = make_grid(4, 4);
  mesh.positions.col(2) = (3 * mesh.positions.col(0)).array().sin() * mesh.positions.col(1).array();
  const Vertices drawn = SmoothSurface(mesh.triangles, 2).positions(mesh.positions);
  for (const Eigen::Index corner : {0, 4, 20, 24}) {
    EXPECT_LT((drawn.row(corner) - mesh.positions.row(corner)).norm(), 1e-12) << corner;
  }
}

TEST(SmoothSurface, HasNoGaps) {
  const Mesh mesh = dome(5);
  const SmoothSurface surface(mesh.triangles, 2);
  std::map<Edge, int> uses;
  for (const Triangle& t : surface.triangles()) {
    for (std::size_t c = 0; c < 3; ++c) ++uses[{std::min(t[c], t[(c + 1) % 3]), std::max(t[c], t[(c + 1) % 3])}];
  }
  EXPECT_EQ(std::ranges::count_if(uses, [](const auto& use) { return use.second == 1; }), 4 * 5 * 4);
  EXPECT_TRUE(std::ranges::all_of(uses, [](const auto& use) { return use.second <= 2; }));
}

TEST(SmoothSurface, TakesWhatNoSurfaceIs) {
  // Three triangles at one edge, two fans at one vertex, a triangle of two vertices, and no triangles.
  const Vertices points = Vertices::Random(9, 3);
  for (const std::vector<Triangle>& triangles :
       {std::vector<Triangle>{{0, 1, 2}, {0, 1, 3}, {1, 0, 4}}, {{0, 1, 2}, {0, 3, 4}}, {{0, 0, 1}, {1, 2, 3}}, {}}) {
    const SmoothSurface surface(triangles, 2);
    EXPECT_TRUE(surface.positions(points).allFinite());
  }
}

TEST(SmoothSurface, IsAsFineAsThePictureAsks) {
  EXPECT_EQ(SmoothSurface::levels_for(800, 480 * 400), 1);
  EXPECT_EQ(SmoothSurface::levels_for(3200, 480 * 400), 0);
  EXPECT_EQ(SmoothSurface::levels_for(3200, 1920 * 1080), 2);
  EXPECT_EQ(SmoothSurface::levels_for(180000, 480 * 400), 0);
  EXPECT_LE(15000 << (2 * SmoothSurface::levels_for(15000, 8192.0 * 8192)), 60000);
}

TEST(Hem, GoesAroundTheBorderAsThickAsTheCloth) {
  const Mesh mesh = make_grid(6, 6);
  const SmoothSurface surface(mesh.triangles, 1);
  const Hem hem(surface, 0.004);
  Vertices positions = surface.positions(mesh.positions);
  Vertices normals = vertex_normals(positions, surface.triangles());
  const Eigen::Index first = positions.rows();
  hem.append(positions, normals);
  EXPECT_EQ(positions.rows() - first, 3 * 4 * 12);
  EXPECT_EQ(hem.triangles().size(), 4U * 4 * 12);
  const auto tube = positions.bottomRows(positions.rows() - first);
  EXPECT_NEAR(tube.col(2).maxCoeff(), 0.002, 1e-9);
  EXPECT_NEAR(tube.col(2).minCoeff(), -0.002, 1e-9);
  EXPECT_NEAR(tube.col(0).maxCoeff(), 1.002, 1e-9);
  // Its triangles face outwards.
  for (const Triangle& t : hem.triangles()) {
    const Vector3d a = positions.row(t[0]), b = positions.row(t[1]), c = positions.row(t[2]);
    const Vector3d outwards = (normals.row(t[0]) + normals.row(t[1]) + normals.row(t[2])).transpose();
    EXPECT_GT((b - a).cross(c - a).dot(outwards), 0);
  }
  EXPECT_TRUE(Hem(surface, 0).triangles().empty());
}

}  // namespace
}  // namespace drape::test
