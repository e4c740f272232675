#include "render/texture_footprint.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstddef>

namespace drape {
namespace {

/// Excess over a number of samples that is too small to be seen.
constexpr double slack = 1.05;

}  // namespace

int most_footprint_samples(int anisotropy) {
  return std::max(1, static_cast<int>(std::ceil(anisotropy / tolerated_stretch)));
}

int footprint_samples(const Eigen::Matrix2d& change, int anisotropy) {
  const double a = change.col(0).squaredNorm(), b = change.col(0).dot(change.col(1)), c = change.col(1).squaredNorm();
  const double middle = (a + c) / 2, apart = std::sqrt((a - c) * (a - c) / 4 + b * b);
  const double longest = std::sqrt(middle + apart), shortest = std::sqrt(std::max(middle - apart, 0.0));
  const double width = std::max({tolerated_stretch * shortest, tolerated_stretch * longest / anisotropy, 1.0});
  const double needed = longest / width;
  if (!(needed > slack)) return 1;
  return needed <= 2 * slack ? std::min(2, most_footprint_samples(anisotropy)) : most_footprint_samples(anisotropy);
}

const std::vector<int>& TextureFootprints::count(const Shot& shot, const Vertices& positions,
                                                 std::span<const Triangle> triangles, Eigen::Vector2i picture) {
  const Eigen::Matrix4d to_clip = shot.view_projection.cast<double>();
  const Eigen::MatrixX4d clip = (positions * to_clip.leftCols<3>().transpose()).rowwise() + to_clip.col(3).transpose();
  samples_.assign(triangles.size(), 1);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    if (edges_[t].isZero(0)) continue;
    Eigen::Matrix<double, 2, 3> places;  // [pixels]
    bool behind = false;
    for (std::size_t c = 0; c < 3; ++c) {
      const auto corner = clip.row(triangles[t][c]);
      behind = behind || !(corner[3] > 0);
      places.col(static_cast<Eigen::Index>(c)) =
          corner.head<2>().transpose().cwiseProduct(picture.cast<double>()) / (2 * corner[3]);
    }
    if (behind) continue;
    Eigen::Matrix2d sides;
    sides << places.col(1) - places.col(0), places.col(2) - places.col(0);
    if (sides.determinant() != 0) samples_[t] = footprint_samples(edges_[t] * sides.inverse(), anisotropy_);
  }
  return samples_;
}

}  // namespace drape
