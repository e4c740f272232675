#include "render/depth_map.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace drape {
namespace {

/// Returns the first texel whose middle is at or after x; texel k has its middle at k + ½.
int first_texel(double x) { return static_cast<int>(std::ceil(x - 0.5)); }

/// An edge from p up to q. Both of its triangles compute bitwise equal crossings.
class RisingEdge {
 public:
  RisingEdge(const double* p, const double* q) : x_(p[0]), y_(p[1]), slope_((q[0] - p[0]) / (q[1] - p[1])) {}

  /// Returns the position where the edge crosses the middle of a row.
  [[nodiscard]] double at(double middle) const { return x_ + (middle - y_) * slope_; }

 private:
  double x_, y_, slope_;
};

bool is_below(const double* p, const double* q) { return p[1] < q[1] || (p[1] == q[1] && p[0] < q[0]); }

}  // namespace

void DepthMap::look(const Eigen::Vector3d& towards, const Eigen::Vector3d& up) {
  const Eigen::Vector3d right = up.cross(towards);
  const Eigen::Vector3d across = right.norm() > 1e-6 ? Eigen::Vector3d(right.normalized()) : towards.unitOrthogonal();
  axes_ << across.transpose(), towards.cross(across).transpose(), towards.transpose();
}

void DepthMap::draw(const Vertices& positions, const std::vector<Triangle>& triangles, double texel, int largest) {
  projected_.noalias() = positions * axes_.transpose();
  columns_ = rows_ = 0;
  nearest_.clear();
  farthest_.clear();
  if (!place(texel, largest)) return;
  for (const Triangle& triangle : triangles) fill(triangle);
}

// Numbers too large or too small for the map leave it empty: nothing would be visible in such a picture.
bool DepthMap::place(double texel, int largest) {
  if (projected_.rows() == 0 || !projected_.allFinite() || !std::isnormal(texel) || texel < 0) return false;
  const Eigen::RowVector3d low = projected_.colwise().minCoeff(), high = projected_.colwise().maxCoeff();
  texel_ = texel;
  while ((high - low).head<2>().maxCoeff() > (largest - 3.0 * block) * texel_) texel_ *= 2;

  const double width = block * texel_;
  const auto blocks_before = [width](double x) { return std::floor(x / width) - 1; };
  const double left = blocks_before(low[0]), bottom = blocks_before(low[1]);
  const double columns = block * (blocks_before(high[0]) + 3 - left),
               rows = block * (blocks_before(high[1]) + 3 - bottom);
  projected_.col(0) = (projected_.col(0).array() / texel_ - block * left).matrix();
  projected_.col(1) = (projected_.col(1).array() / texel_ - block * bottom).matrix();
  const auto fits = [&](Eigen::Index axis, double texels) {
    return texels <= largest + block && projected_.col(axis).minCoeff() >= 1 &&
           projected_.col(axis).maxCoeff() <= texels - 1;
  };
  if (!projected_.allFinite() || !fits(0, columns) || !fits(1, rows)) return false;
  columns_ = static_cast<int>(columns);
  rows_ = static_cast<int>(rows);
  projected_.col(2).array() -= low[2];
  u_ << axes_.row(0).transpose() / texel_, -block * left;
  v_ << axes_.row(1).transpose() / texel_, -block * bottom;
  depth_ << axes_.row(2).transpose(), -low[2];

  const auto count = static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_);
  nearest_.assign(count, static_cast<float>(-width));
  farthest_.assign(count, static_cast<float>(high[2] - low[2] + width));
  return true;
}

void DepthMap::fill(const Triangle& triangle) {
  const double* a = projected_.row(triangle[0]).data();
  const double* b = projected_.row(triangle[1]).data();
  const double* c = projected_.row(triangle[2]).data();
  if (is_below(b, a)) std::swap(a, b);
  if (is_below(c, b)) std::swap(b, c);
  if (is_below(b, a)) std::swap(a, b);
  const int bottom = first_texel(a[1]), top = first_texel(c[1]);
  if (bottom == top) return;
  const std::array<double, 3> ab{b[0] - a[0], b[1] - a[1], b[2] - a[2]}, ac{c[0] - a[0], c[1] - a[1], c[2] - a[2]};
  const double area = ab[0] * ac[1] - ab[1] * ac[0];
  if (area == 0) return;
  const double slope = (ab[2] * ac[1] - ac[2] * ab[1]) / area, rise = (ac[2] * ab[0] - ab[2] * ac[0]) / area;
  const auto lowest = static_cast<float>(std::min({a[2], b[2], c[2]}));
  const auto highest = static_cast<float>(std::max({a[2], b[2], c[2]}));
  const RisingEdge whole(a, c), lower(a, b), upper(b, c);
  for (int row = bottom; row < top; ++row) {
    const double middle = row + 0.5;
    const double one = whole.at(middle), other = middle < b[1] ? lower.at(middle) : upper.at(middle);
    const int from = first_texel(std::min(one, other)), count = first_texel(std::max(one, other)) - from;
    const auto start = static_cast<float>(a[2] + (from + 0.5 - a[0]) * slope + (middle - a[1]) * rise);
    const auto step = static_cast<float>(slope);
    const std::size_t first = static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_);
    float* nearest = nearest_.data() + first + from;
    float* farthest = farthest_.data() + first + from;
    for (int k = 0; k < count; ++k) {
      const float depth = std::min(std::max(start + static_cast<float>(k) * step, lowest), highest);
      nearest[k] = std::max(nearest[k], depth);
      farthest[k] = std::min(farthest[k], depth);
    }
  }
}

float interpolated(const DepthMap& map, const std::vector<float>& values, double column, double row) {
  // In this order min and max turn NaN into 0.
  const double x = std::min(std::max(0.0, column - 0.5), map.columns() - 1.001);
  const double y = std::min(std::max(0.0, row - 0.5), map.rows() - 1.001);
  const int left = static_cast<int>(x), bottom = static_cast<int>(y);
  const auto across = static_cast<float>(x - left), up = static_cast<float>(y - bottom);
  const float* lower =
      values.data() + static_cast<std::size_t>(bottom) * static_cast<std::size_t>(map.columns()) + left;
  const float* upper = lower + map.columns();
  const float below = lower[0] + across * (lower[1] - lower[0]), above = upper[0] + across * (upper[1] - upper[0]);
  return below + up * (above - below);
}

}  // namespace drape
