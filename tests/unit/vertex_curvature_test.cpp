#include "drape/sim/mesh.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace drape {
namespace {

/// Returns the inner vertices of a grid.
std::vector<int> inner(int columns, int rows) {
  std::vector<int> vertices;
  for (int j = 1; j < rows; ++j) {
    for (int i = 1; i < columns; ++i) vertices.push_back(j * (columns + 1) + i);
  }
  return vertices;
}

TEST(VertexCurvature, OfAFlatSheetIsZero) {
  const Mesh mesh = make_grid(5, 4);
  EXPECT_EQ(VertexCurvature(30, mesh.triangles)(mesh.positions).maxCoeff(), 0);
}

TEST(VertexCurvature, OfACylinderIsHalfOfOneOverItsRadius) {
  const double radius = 0.7;
  Mesh mesh = make_grid(40, 6);
  for (auto row : mesh.positions.rowwise()) {
    const double angle = row[0];
    row << radius * std::sin(angle), row[1], radius * std::cos(angle);
  }
  const Eigen::VectorXd curvature = VertexCurvature(41 * 7, mesh.triangles)(mesh.positions);
  for (const int vertex : inner(40, 6)) EXPECT_NEAR(curvature[vertex], 1 / (2 * radius), 1e-3);
}

TEST(VertexCurvature, OfASphereIsOneOverItsRadius) {
  const double radius = 2;
  Mesh mesh = make_grid(60, 60);
  for (auto row : mesh.positions.rowwise()) row = Eigen::RowVector3d(row[0], row[1], 3).normalized() * radius;
  const Eigen::VectorXd curvature = VertexCurvature(61 * 61, mesh.triangles)(mesh.positions);
  double sum = 0;
  const std::vector<int> vertices = inner(60, 60);
  for (const int vertex : vertices) sum += curvature[vertex];
  // Slightly more: in the sheared grid a diagonal bends inwards, and the others bend outwards more.
  EXPECT_NEAR(sum / static_cast<double>(vertices.size()), 1 / radius, 0.04 / radius);
}

TEST(VertexCurvature, DoesNotDependOnHowTrianglesAreWound) {
  Mesh mesh = make_grid(4, 4);
  for (auto row : mesh.positions.rowwise()) row[2] = 0.3 * row[0] * row[0];
  const Eigen::VectorXd expected = VertexCurvature(25, mesh.triangles)(mesh.positions);
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 3) std::swap(mesh.triangles[t][0], mesh.triangles[t][1]);
  EXPECT_LT((VertexCurvature(25, mesh.triangles)(mesh.positions) - expected).cwiseAbs().maxCoeff(), 1e-12);
}

}  // namespace
}  // namespace drape
