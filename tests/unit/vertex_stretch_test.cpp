#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "drape/sim/mesh.hpp"

namespace drape {
namespace {

Vertices mapped(const Vertices& x, const Eigen::Matrix3d& f) { return x * f.transpose(); }

Eigen::Matrix3d any_rotation() {
  return (Eigen::AngleAxisd(0.7, Eigen::Vector3d::UnitX()) * Eigen::AngleAxisd(-1.9, Eigen::Vector3d::UnitZ()))
      .toRotationMatrix();
}

TEST(VertexStretch, IsOneWhereAClothIsOnlyMoved) {
  const Mesh mesh = make_grid(3, 4);
  const VertexStretch stretch(mesh.positions, mesh.triangles);
  const Vertices turned = mapped(mesh.positions, any_rotation()).rowwise() + Eigen::RowVector3d(3, -1, 2);
  EXPECT_LT((stretch(turned).array() - 1).abs().maxCoeff(), 1e-14);
}

TEST(VertexStretch, IsTheStretchInWhateverDirectionAndMesh) {
  for (const double angle : {0.0, 0.3, 0.785, 1.5}) {
    const Eigen::Matrix3d axis = Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    const Eigen::Matrix3d f = axis * Eigen::Vector3d(1.37, 1, 1).asDiagonal() * axis.transpose();
    for (const Mesh& mesh : {make_grid(3, 4), make_grid(1, 7)}) {
      const VertexStretch stretch(mesh.positions, mesh.triangles);
      const Vertices x = mapped(mesh.positions, any_rotation() * f);
      EXPECT_LT((stretch(x).array() - 1.37).abs().maxCoeff(), 1e-14) << angle;
    }
  }
}

// Its greatest principal stretch has s + 1/s = √(γ² + 4), from λ² of FᵀF = [1 γ; γ 1+γ²].
TEST(VertexStretch, OfASimpleShearIsThatOfTheTextbook) {
  const Mesh mesh = make_grid(2, 2);
  const double gamma = 0.8, expected = (std::sqrt(gamma * gamma + 4) + gamma) / 2;
  Eigen::Matrix3d f = Eigen::Matrix3d::Identity();
  f(0, 1) = gamma;
  const VertexStretch stretch(mesh.positions, mesh.triangles);
  EXPECT_LT((stretch(mapped(mesh.positions, f)).array() - expected).abs().maxCoeff(), 1e-14);
}

TEST(VertexStretch, SaysNothingWhereThereIsNoArea) {
  Vertices x(5, 3);
  x << 0, 0, 0, 1, 0, 0, 2, 0, 0, 0, 1, 0, 9, 9, 9;
  const VertexStretch stretch(x, {{0, 1, 2}, {0, 1, 3}});  // the first is a line; no triangle has the last vertex
  EXPECT_EQ(stretch(2 * x), (Eigen::VectorXd(5) << 2, 2, 1, 2, 1).finished());
}

}  // namespace
}  // namespace drape
