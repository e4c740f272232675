#include "render/ground_shadow.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace drape {
namespace {

constexpr int merged_texels = 2;                  // texels of the map along each side of a pixel
constexpr int sharp_radius = 1, soft_radius = 6;  // radii of the box blurs [pixels]
constexpr int soft_border = 3 * soft_radius + 1;  // width of the softest edge on each side [pixels]
constexpr double lowest_light = 0.02;             // least cosine between light and normal

}  // namespace

void GroundShadow::cast(const DepthMap& map, const GroundShape& ground, const Eigen::Vector3d& to_light,
                        double softening) {
  light_ = to_light;
  if (map.columns() == 0 || !reaches(ground, to_light)) return clear();
  project(map, ground, softening);
  blur(sharp_, sharp_radius);
  blur(soft_, soft_radius);
  pixels_.resize(sharp_.size());
  for (std::size_t i = 0; i < pixels_.size(); ++i) {
    pixels_[i] = static_cast<std::uint16_t>(std::lround(65535 * std::clamp(sharp_[i] + soft_[i], 0.0F, 1.0F)));
  }
}

bool GroundShadow::reaches(const GroundShape& ground, const Eigen::Vector3d& to_light) {
  return ground.normal.dot(to_light) >= lowest_light;
}

std::vector<Eigen::Vector3d> GroundShadow::corners(const GroundShape& ground) const {
  std::vector<Eigen::Vector3d> points;
  if (u_.isZero(0)) return points;
  const Eigen::Vector3d across = u_.head<3>() / u_.head<3>().squaredNorm(),
                        along = v_.head<3>() / v_.head<3>().squaredNorm();
  for (const double u : {0.0, 1.0}) {
    for (const double v : {0.0, 1.0}) {
      const Eigen::Vector3d p = (u - u_[3]) * across + (v - v_[3]) * along;
      points.emplace_back(p + (ground.height - ground.normal.dot(p)) / ground.normal.dot(light_) * light_);
    }
  }
  return points;
}

void GroundShadow::clear() {
  columns_ = rows_ = 1;
  pixels_.assign(1, 0);
  u_.setZero();
  v_.setZero();
}

// The ground's depth in the map is a·column + b·row + c. The ray through a point p of the map, p + t·light, meets the
// ground where n·p + t n·light equals the ground's height.
void GroundShadow::project(const DepthMap& map, const GroundShape& ground, double softening) {
  const double texel = map.texel();
  const Eigen::Vector3d right = texel * map.u().head<3>(), up = texel * map.v().head<3>(),
                        light = map.depth().head<3>();
  const double rise = ground.normal.dot(light);
  const double a = -ground.normal.dot(right) * texel / rise, b = -ground.normal.dot(up) * texel / rise;
  const double c = ground.height / rise + map.depth()[3] - a * map.u()[3] - b * map.v()[3];

  const int inner_columns = map.columns() / merged_texels, inner_rows = map.rows() / merged_texels;
  columns_ = inner_columns + 2 * soft_border;
  rows_ = inner_rows + 2 * soft_border;
  sharp_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), 0.0F);
  soft_ = sharp_;
  for (int row = 0; row < inner_rows * merged_texels; ++row) {
    const auto stride = static_cast<std::size_t>(map.columns());
    const float* nearest = map.nearest().data() + static_cast<std::size_t>(row) * stride;
    const float* farthest = map.farthest().data() + static_cast<std::size_t>(row) * stride;
    const std::size_t place =
        static_cast<std::size_t>(row / merged_texels + soft_border) * static_cast<std::size_t>(columns_);
    for (int column = 0; column < inner_columns * merged_texels; ++column) {
      if (nearest[column] < farthest[column]) continue;  // empty texel
      const double height = double{farthest[column]} - (a * (column + 0.5) + b * (row + 0.5) + c);
      const auto relative = static_cast<float>(std::max(height * rise, 0.0) / softening);
      const float sharpness = 1 / (1 + relative + relative * relative);
      const std::size_t pixel = place + static_cast<std::size_t>(column / merged_texels + soft_border);
      constexpr float part = 1.0F / (merged_texels * merged_texels);
      sharp_[pixel] += part * sharpness;
      soft_[pixel] += part * (1 - sharpness);
    }
  }
  u_ = map.u() / merged_texels;
  v_ = map.v() / merged_texels;
  u_[3] += soft_border;
  v_[3] += soft_border;
  u_ /= columns_;
  v_ /= rows_;
}

// Three box filters along each axis approximate a Gaussian. All run along columns, because processors add rows of sums
// fast; the image is transposed in between.
void GroundShadow::blur(std::vector<float>& image, int radius) {
  auto width = static_cast<std::size_t>(columns_), height = static_cast<std::size_t>(rows_);
  for (int axis = 0; axis < 2; ++axis) {
    for (int pass = 0; pass < 3; ++pass) blur_columns(image, width, height, static_cast<std::size_t>(radius));
    for (std::size_t row = 0; row < height; ++row) {
      for (std::size_t column = 0; column < width; ++column) {
        scratch_[column * height + row] = image[row * width + column];
      }
    }
    std::swap(image, scratch_);
    std::swap(width, height);
  }
}

void GroundShadow::blur_columns(std::vector<float>& image, std::size_t width, std::size_t height, std::size_t radius) {
  scratch_.resize(image.size());
  sums_.assign(width, 0.0F);
  const auto add = [&](std::size_t row) {
    for (std::size_t k = 0; k < width; ++k) sums_[k] += image[row * width + k];
  };
  const float scale = 1.0F / static_cast<float>(2 * radius + 1);
  for (std::size_t row = 0; row < radius; ++row) add(row);
  for (std::size_t row = 0; row < height; ++row) {
    if (row + radius < height) add(row + radius);
    if (row > radius) {
      for (std::size_t k = 0; k < width; ++k) sums_[k] -= image[(row - radius - 1) * width + k];
    }
    for (std::size_t k = 0; k < width; ++k) scratch_[row * width + k] = sums_[k] * scale;
  }
  std::swap(image, scratch_);
}

}  // namespace drape
