#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "render/depth_map.hpp"
#include "sim/collider.hpp"

namespace drape {

/// The shadow of a cloth on a ground, as a picture seen from the light. Where the cloth is near the ground the shadow's
/// edge is sharp, higher up it is soft: as every point of the ground has one place in the picture, edges can be
/// softened here, once a frame, and not in every pixel.
class GroundShadow {
 public:
  /// Casts the shadow.
  /// @param map       of the cloth, seen from the light
  /// @param to_light  unit vector; from a light below the ground there is no shadow on it
  /// @param softening height of the cloth above the ground from which on the shadow is mostly soft [m]
  void cast(const DepthMap& map, const GroundShape& ground, const Eigen::Vector3d& to_light, double softening);

  /// Whether the light reaches a ground at all, so that there can be a shadow.
  [[nodiscard]] static bool reaches(const GroundShape& ground, const Eigen::Vector3d& to_light);
  /// The four points of the ground at the corners of the picture, beyond which there is no shadow; none without a
  /// picture.
  [[nodiscard]] std::vector<Eigen::Vector3d> corners(const GroundShape& ground) const;

  [[nodiscard]] int columns() const { return columns_; }
  [[nodiscard]] int rows() const { return rows_; }
  /// How much of the light is taken, from 0 to 65535, rows from below; 0 along the border.
  [[nodiscard]] const std::vector<std::uint16_t>& pixels() const { return pixels_; }
  /// A point x of the ground is at texture coordinates (u·(x, 1), v·(x, 1)), 0 to 1 within the picture.
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
