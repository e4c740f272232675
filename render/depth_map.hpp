#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "sim/mesh.hpp"

namespace drape {

/// A cloth as it is seen from infinitely far away, along one direction: of each texel, how near its nearest piece comes
/// and how far away its farthest lies. The middles of the texels are places that never move, whatever the cloth does
/// and however much of the plane it takes: what is made of the map does not flicker from frame to frame. Drawn here and
/// not by OpenGL, so that its bits are the same everywhere; between two triangles there is neither a gap nor an
/// overlap.
class DepthMap {
 public:
  /// Columns and rows come in blocks of so many, which do not move either; the outermost texels are empty.
  static constexpr int block = 16;

  /// @param towards unit vector from the cloth to where it is seen from
  /// @param up      where rows lead to, as far as `towards` allows: in the mirror image of a scene both are mirrored
  void look(const Eigen::Vector3d& towards, const Eigen::Vector3d& up);

  /// Leaves the map empty where a number is not finite, or too large or small beside the others.
  /// @param texel width of a texel [m]; doubled until no side has more than `largest` of them
  void draw(const Vertices& positions, const std::vector<Triangle>& triangles, double texel, int largest);

  /// 0 where the cloth has no place.
  [[nodiscard]] int columns() const { return columns_; }
  [[nodiscard]] int rows() const { return rows_; }
  [[nodiscard]] double texel() const { return texel_; }  ///< [m]

  /// How far towards the eye the cloth reaches in each texel [m], row by row, above its lowest point. Where it is
  /// empty, a block's width below that.
  [[nodiscard]] const std::vector<float>& nearest() const { return nearest_; }
  /// The same of the piece that is farthest away. Where there is none, a block's width above the highest point.
  [[nodiscard]] const std::vector<float>& farthest() const { return farthest_; }

  /// Column, row and depth of each vertex.
  using Places = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;
  [[nodiscard]] const Places& places() const { return projected_; }

  /// A point p is at column u·(p, 1) and row v·(p, 1), where texel k reaches from k to k+1, and at depth·(p, 1) of the
  /// maps.
  [[nodiscard]] const Eigen::Vector4d& u() const { return u_; }
  [[nodiscard]] const Eigen::Vector4d& v() const { return v_; }
  [[nodiscard]] const Eigen::Vector4d& depth() const { return depth_; }

 private:
  bool place(double texel, int largest);
  void fill(const Triangle& triangle);

  Eigen::Matrix3d axes_ = Eigen::Matrix3d::Identity();  // rows: to where columns, rows and depths grow
  Places projected_;
  double texel_ = 0;
  int columns_ = 0, rows_ = 0;
  std::vector<float> nearest_, farthest_;
  Eigen::Vector4d u_ = Eigen::Vector4d::Zero(), v_ = u_, depth_ = u_;
};

/// A map's value between the middles of its texels, of which the nearest two by two are weighted.
/// @param values of map.nearest() or map.farthest()
/// @param column,row the place, within the map
float interpolated(const DepthMap& map, const std::vector<float>& values, double column, double row);

}  // namespace drape
