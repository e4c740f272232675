#include "render/ambient_occlusion.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace drape {
namespace {

/// Largest side of a map [texels].
constexpr int largest_view = 256;
/// Lengths in texels: offset of the sampled point above its vertex, which keeps the ends of folds; depth differences
/// that count as the point's own neighbourhood; and the further difference at which all light is blocked.
constexpr double lifted = 1;
constexpr float nearby = 0.05F, fading = 0.4F;
/// Least cosine of incidence: a map cannot judge flatter light.
constexpr float flattest = 0.12F;

/// V. I. Lebedev, "Quadratures on a sphere", Zh. vychisl. Mat. mat. Fiz. 16 (1976): weights of the points (1,0,0) and
/// (1,1,1)/√3 and of all their mirror images, of degree 5. They sum to 1.
constexpr float axis_weight = 1.0F / 15, corner_weight = 3.0F / 40;

}  // namespace

AmbientOcclusion::AmbientOcclusion() {
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = 0; z <= 1; ++z) {
        if (z == 0 && (y < 0 || (y == 0 && x <= 0))) continue;  // opposite end of an existing axis
        const int sides = std::abs(x) + std::abs(y) + z;
        const Eigen::Vector3d direction = Eigen::Vector3d(x, y, z).normalized();
        if (sides == 2) continue;
        Axis& axis = axes_.emplace_back(Axis{direction, sides == 1 ? axis_weight : corner_weight, {}});
        axis.map.look(direction, x == 0 && y == 0 ? Eigen::Vector3d::UnitY() : Eigen::Vector3d::UnitZ());
      }
    }
  }
}

const std::vector<AmbientOcclusion::Sides>& AmbientOcclusion::compute(const Vertices& positions,
                                                                      const Vertices& normals,
                                                                      const std::vector<Triangle>& triangles,
                                                                      double texel) {
  const auto count = static_cast<std::size_t>(positions.rows());
  reached_.assign(count, Sides{});
  whole_.assign(count, Sides{});
  for (Axis& axis : axes_) {
    axis.map.draw(positions, triangles, texel, largest_view);
    gather(axis, normals);
  }
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t side = 0; side < 2; ++side) {
      reached_[i][side] = whole_[i][side] > 0 ? reached_[i][side] / whole_[i][side] : 1;
    }
  }
  smooth(triangles);
  return reached_;
}

// Gives each vertex the mean over its triangles of their corners' mean. This evens out details smaller than a texel.
void AmbientOcclusion::smooth(const std::vector<Triangle>& triangles) {
  struct Sum {
    Sides light{};
    float count = 0;
  };
  std::vector<Sum> sums(reached_.size());
  for (const Triangle& triangle : triangles) {
    Sides mean{};
    for (const int vertex : triangle) {
      for (std::size_t side = 0; side < 2; ++side) mean[side] += reached_[static_cast<std::size_t>(vertex)][side];
    }
    for (const int vertex : triangle) {
      Sum& sum = sums[static_cast<std::size_t>(vertex)];
      for (std::size_t side = 0; side < 2; ++side) sum.light[side] += mean[side] / 3;
      sum.count += 1;
    }
  }
  for (std::size_t i = 0; i < sums.size(); ++i) {
    if (sums[i].count == 0) continue;
    for (std::size_t side = 0; side < 2; ++side) reached_[i][side] = sums[i].light[side] / sums[i].count;
  }
}

void AmbientOcclusion::gather(const Axis& axis, const Vertices& normals) {
  const DepthMap& map = axis.map;
  if (map.columns() == 0) return;
  const double lift = lifted * map.texel();
  const auto open = [scale = 1 / (fading * static_cast<float>(map.texel()))](float hidden) {
    return 1 - std::clamp(hidden * scale - nearby / fading, 0.0F, 1.0F);
  };
  for (Eigen::Index i = 0; i < normals.rows(); ++i) {
    const Eigen::Vector3d normal = normals.row(i).transpose();
    const double facing = normal.dot(axis.direction);
    const auto cosine = static_cast<float>(std::abs(facing));
    if (cosine < flattest) continue;
    // The side that faces the direction is lifted to there, the other to the other end.
    const double sign = facing > 0 ? lift : -lift;
    const double right = sign * map.u().head<3>().dot(normal), up = sign * map.v().head<3>().dot(normal);
    const double column = map.places()(i, 0), row = map.places()(i, 1), depth = map.places()(i, 2);
    const double above = sign * facing;
    const float before = interpolated(map, map.nearest(), column + right, row + up) - static_cast<float>(depth + above);
    const float behind =
        static_cast<float>(depth - above) - interpolated(map, map.farthest(), column - right, row - up);
    const std::size_t vertex = static_cast<std::size_t>(i), towards = facing > 0 ? 0 : 1;
    const float light = axis.weight * cosine;
    whole_[vertex][towards] += light;
    reached_[vertex][towards] += light * open(before);
    whole_[vertex][1 - towards] += light;
    reached_[vertex][1 - towards] += light * open(behind);
  }
}

}  // namespace drape
