#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "sim/mesh.hpp"

namespace drape {

/// Orthographic view of a cloth along one direction: depths of the nearest and the farthest surface in each texel. The
/// grid of texels is fixed in space, however the cloth moves or grows, so results do not flicker between frames. It is
/// drawn here and not by OpenGL, so that its bits are the same everywhere. Neighbouring triangles leave no gap and do
/// not overlap.
class DepthMap {
 public:
  /// Columns and rows come in blocks of this many texels, also fixed in space; the outermost texels are empty.
  static constexpr int block = 16;

  /// @param towards unit vector from the cloth to the viewer
  /// @param up      approximate direction of growing rows; a mirrored scene mirrors both vectors
  void look(const Eigen::Vector3d& towards, const Eigen::Vector3d& up);

  /// Draws the map. It stays empty if a number is not finite, or too large or small relative to the others.
  /// @param texel width of a texel [m]; doubled until no side has more than `largest` of them
  void draw(const Vertices& positions, const std::vector<Triangle>& triangles, double texel, int largest);

  /// Number of columns; 0 for an empty map.
  [[nodiscard]] int columns() const { return columns_; }
  [[nodiscard]] int rows() const { return rows_; }
  [[nodiscard]] double texel() const { return texel_; }  ///< [m]

  /// Depth of the nearest surface in each texel [m], row by row: height towards the viewer above the cloth's lowest
  /// point. Empty texels hold minus one block's width.
  [[nodiscard]] const std::vector<float>& nearest() const { return nearest_; }
  /// Depth of the farthest surface [m]. Empty texels hold a block's width above the highest point.
  [[nodiscard]] const std::vector<float>& farthest() const { return farthest_; }

  /// Column, row and depth of each vertex.
  using Places = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;
  [[nodiscard]] const Places& places() const { return projected_; }

  /// Coefficients of a point p's column u·(p, 1), row v·(p, 1) and depth(p) = depth·(p, 1). Texel k covers columns k to
  /// k+1.
  [[nodiscard]] const Eigen::Vector4d& u() const { return u_; }
  [[nodiscard]] const Eigen::Vector4d& v() const { return v_; }
  [[nodiscard]] const Eigen::Vector4d& depth() const { return depth_; }

 private:
  bool place(double texel, int largest);
  void fill(const Triangle& triangle);

  Eigen::Matrix3d axes_ = Eigen::Matrix3d::Identity();  // rows: directions of growing columns, rows and depths
  Places projected_;
  double texel_ = 0;
  int columns_ = 0, rows_ = 0;
  std::vector<float> nearest_, farthest_;
  Eigen::Vector4d u_ = Eigen::Vector4d::Zero(), v_ = u_, depth_ = u_;
};

/// Interpolates a map bilinearly between the middles of its texels.
/// @param values map.nearest() or map.farthest()
/// @param column,row position within the map
float interpolated(const DepthMap& map, const std::vector<float>& values, double column, double row);

}  // namespace drape
