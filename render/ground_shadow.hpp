#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "render/depth_map.hpp"
#include "sim/collider.hpp"

namespace drape {

/// The shadow of a cloth on a ground, as a picture seen from the light. Its edge is sharp where the cloth is near the
/// ground and soft higher up. Each point of the ground has one pixel in the picture, so edges are softened once per
/// frame instead of in every drawn pixel.
class GroundShadow {
 public:
  /// Casts the shadow.
  /// @param map       depth map of the cloth, seen from the light
  /// @param to_light  unit vector; a light below the ground casts no shadow on it
  /// @param softening height of the cloth above the ground from which the shadow is mostly soft [m]
  void cast(const DepthMap& map, const GroundShape& ground, const Eigen::Vector3d& to_light, double softening);

  /// Returns true if the light reaches a ground, so that there can be a shadow.
  [[nodiscard]] static bool reaches(const GroundShape& ground, const Eigen::Vector3d& to_light);
  /// Returns the four points of the ground at the picture's corners; no shadow lies outside. Empty without a picture.
  [[nodiscard]] std::vector<Eigen::Vector3d> corners(const GroundShape& ground) const;

  [[nodiscard]] int columns() const { return columns_; }
  [[nodiscard]] int rows() const { return rows_; }
  /// Blocked part of the light, 0 to 65535, rows from below; 0 along the border.
  [[nodiscard]] const std::vector<std::uint16_t>& pixels() const { return pixels_; }
  /// Coefficients of a ground point x's texture coordinates (u·(x, 1), v·(x, 1)), 0 to 1 within the picture.
  [[nodiscard]] const Eigen::Vector4d& u() const { return u_; }
  [[nodiscard]] const Eigen::Vector4d& v() const { return v_; }

 private:
  void clear();
  void project(const DepthMap& map, const GroundShape& ground, double softening);
  void blur(std::vector<float>& image, int radius);
  void blur_columns(std::vector<float>& image, std::size_t width, std::size_t height, std::size_t radius);

  int columns_ = 0, rows_ = 0;
  std::vector<float> sharp_, soft_, scratch_, sums_;
  std::vector<std::uint16_t> pixels_;
  Eigen::Vector4d u_ = Eigen::Vector4d::Zero(), v_ = u_;
  Eigen::Vector3d light_ = Eigen::Vector3d::UnitZ();
};

}  // namespace drape
