#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "sim/collider.hpp"
#include "sim/mesh.hpp"

namespace drape {

/// The shadow of a cloth on a ground as a picture that lies on it. Where the cloth is near the ground the shadow's edge
/// is sharp, higher up it is soft. Computed here and not by OpenGL, so that its bytes are the same everywhere.
class GroundShadow {
 public:
  static constexpr int size = 192;  ///< columns and rows

  explicit GroundShadow(std::vector<Triangle> triangles);

  /// Casts the shadow.
  /// @param to_light unit vector; raised where it is so low that the shadow would have no end
  void cast(const Vertices& positions, const GroundShape& ground, const Eigen::Vector3d& to_light);

  /// How much of the light is taken, size×size from 0 to 65535, rows from below; 0 along the border.
  [[nodiscard]] const std::vector<std::uint16_t>& pixels() const { return pixels_; }
  /// A point x of the ground is at texture coordinates (u·(x, 1), v·(x, 1)), 0 to 1 within the picture.
  [[nodiscard]] const Eigen::Vector4d& u() const { return u_; }
  [[nodiscard]] const Eigen::Vector4d& v() const { return v_; }

 private:
  void project(const Vertices& positions, const GroundShape& ground, const Eigen::Vector3d& to_light);
  void fill(const Triangle& triangle);
  void soften(double sharpness_height);

  std::vector<Triangle> triangles_;
  Vertices projected_;          // of each vertex: column and row in the picture, and height above the ground [m]
  std::vector<float> heights_;  // of the lowest piece of cloth above each texel; negative where there is none
  std::vector<float> sharp_, soft_, scratch_;
  std::vector<std::uint16_t> pixels_;
  Eigen::Vector4d u_, v_;
};

}  // namespace drape
