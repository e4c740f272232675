#include "render/ground_shadow.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

namespace drape {
namespace {

constexpr double lowest_light = 0.45;             // of the light's direction along the normal
constexpr int border = 22;                        // texels that the softest edge takes on each side
constexpr int sharp_radius = 1, soft_radius = 5;  // of the boxes that blur, in texels
constexpr double sharp_part = 0.12;               // the edge softens over this part of the picture's width in height

std::size_t index(int column, int row) {
  return static_cast<std::size_t>(row) * GroundShadow::size + static_cast<std::size_t>(column);
}

/// Three box filters along both axes, which come close to a Gaussian.
void blur(std::vector<float>& image, std::vector<float>& scratch, int radius) {
  constexpr int n = GroundShadow::size;
  const float scale = 1.0F / static_cast<float>(2 * radius + 1);
  for (int pass = 0; pass < 6; ++pass) {  // each along a row, into a column of the transpose
    for (int row = 0; row < n; ++row) {
      float sum = 0;
      for (int k = 0; k < radius; ++k) sum += image[index(k, row)];
      for (int column = 0; column < n; ++column) {
        if (column + radius < n) sum += image[index(column + radius, row)];
        if (column - radius - 1 >= 0) sum -= image[index(column - radius - 1, row)];
        scratch[index(row, column)] = sum * scale;
      }
    }
    std::swap(image, scratch);
  }
}

}  // namespace

GroundShadow::GroundShadow(std::vector<Triangle> triangles)
    : triangles_(std::move(triangles)),
      heights_(index(0, size)),
      sharp_(heights_),
      soft_(heights_),
      scratch_(heights_),
      pixels_(heights_.size()) {}

void GroundShadow::cast(const Vertices& positions, const GroundShape& ground, const Eigen::Vector3d& to_light) {
  std::ranges::fill(heights_, -1.0F);
  project(positions, ground, to_light);
  for (const Triangle& triangle : triangles_) fill(triangle);
  soften(sharp_part / u_.head<3>().norm());
}

void GroundShadow::project(const Vertices& positions, const GroundShape& ground, const Eigen::Vector3d& to_light) {
  const Eigen::Vector3d& n = ground.normal;
  const double rise = n.dot(to_light);
  const Eigen::Vector3d light = rise < lowest_light ? Eigen::Vector3d(to_light + (lowest_light - rise) * n) : to_light;
  const Eigen::Vector3d right = n.unitOrthogonal(), up = n.cross(right);
  // Along the light down to the ground, in the ground's own axes.
  const Eigen::Vector3d across = right - right.dot(light) / n.dot(light) * n;
  const Eigen::Vector3d along = up - up.dot(light) / n.dot(light) * n;
  const double shift_across = right.dot(light) / n.dot(light) * ground.height;
  const double shift_along = up.dot(light) / n.dot(light) * ground.height;
  projected_.resize(positions.rows(), 3);
  projected_.col(0) = ((positions * across).array() + shift_across).matrix();
  projected_.col(1) = ((positions * along).array() + shift_along).matrix();
  projected_.col(2) = ((positions * n).array() - ground.height).cwiseMax(0.0).matrix();

  const Eigen::Vector2d low = projected_.leftCols<2>().colwise().minCoeff();
  const Eigen::Vector2d high = projected_.leftCols<2>().colwise().maxCoeff();
  const double width = std::max((high - low).maxCoeff(), 1e-6);
  const double texels = (size - 2 * border) / width;  // per metre
  const Eigen::Vector2d corner = (low + high) / 2 - Eigen::Vector2d::Constant(size / 2.0 / texels);
  projected_.col(0) = (texels * (projected_.col(0).array() - corner[0])).matrix();
  projected_.col(1) = (texels * (projected_.col(1).array() - corner[1])).matrix();
  const double scale = texels / size;
  u_ << scale * right, -scale * corner[0];
  v_ << scale * up, -scale * corner[1];
}

void GroundShadow::fill(const Triangle& triangle) {
  const Eigen::RowVector3d a = projected_.row(triangle[0]), b = projected_.row(triangle[1]),
                           c = projected_.row(triangle[2]);
  const auto cross = [](double px, double py, double qx, double qy) { return px * qy - py * qx; };
  const double area = cross(b[0] - a[0], b[1] - a[1], c[0] - a[0], c[1] - a[1]);
  if (area == 0 || !std::isfinite(area)) return;
  const auto range = [&](int axis) {
    const auto [low, high] = std::minmax({a[axis], b[axis], c[axis]});
    return std::pair(std::max(static_cast<int>(std::ceil(low - 0.5)), 0),
                     std::min(static_cast<int>(std::floor(high - 0.5)), size - 1));
  };
  const auto [left, right] = range(0);
  const auto [bottom, top] = range(1);
  for (int row = bottom; row <= top; ++row) {
    for (int column = left; column <= right; ++column) {
      const double x = column + 0.5 - a[0], y = row + 0.5 - a[1];
      const double wb = cross(x, y, c[0] - a[0], c[1] - a[1]) / area;
      const double wc = cross(b[0] - a[0], b[1] - a[1], x, y) / area;
      if (wb < 0 || wc < 0 || wb + wc > 1) continue;
      const auto height = static_cast<float>(a[2] + wb * (b[2] - a[2]) + wc * (c[2] - a[2]));
      float& lowest = heights_[index(column, row)];
      if (lowest < 0 || height < lowest) lowest = height;
    }
  }
}

void GroundShadow::soften(double sharpness_height) {
  for (std::size_t i = 0; i < heights_.size(); ++i) {
    const float height = heights_[i];
    const float relative = height / static_cast<float>(sharpness_height);
    sharp_[i] = height < 0 ? 0 : 1 / (1 + relative + relative * relative);
    soft_[i] = height < 0 ? 0 : 1 - sharp_[i];
  }
  blur(sharp_, scratch_, sharp_radius);
  blur(soft_, scratch_, soft_radius);
  for (std::size_t i = 0; i < pixels_.size(); ++i) {
    pixels_[i] = static_cast<std::uint16_t>(std::lround(65535 * std::clamp(sharp_[i] + soft_[i], 0.0F, 1.0F)));
  }
}

}  // namespace drape
