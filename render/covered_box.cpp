#include "render/covered_box.hpp"

#include <algorithm>
#include <limits>

namespace drape {
namespace {

/// Bounding box of points of a shot, in the picture.
class Outline {
 public:
  explicit Outline(const Shot& shot) : to_clip_(shot.view_projection.cast<double>()) {}

  /// @param points n×3 [m]
  void add(const Vertices& points) {
    const Eigen::MatrixX4d clip = (points * to_clip_.leftCols<3>().transpose()).rowwise() + to_clip_.col(3).transpose();
    // A point beside or behind the camera has no position in the picture. NaN fails this comparison as well.
    if (!(clip.col(3).array() > 0).all()) {
      unbounded_ = true;
      return;
    }
    for (int axis = 0; axis < 2; ++axis) {
      const Eigen::ArrayXd place = clip.col(axis).array() / clip.col(3).array();
      unbounded_ = unbounded_ || !place.allFinite();
      low_[axis] = std::min(low_[axis], place.minCoeff());
      high_[axis] = std::max(high_[axis], place.maxCoeff());
    }
  }

  /// Returns the pixels within the outline, enlarged by `border` on each side.
  [[nodiscard]] PixelBox box(Eigen::Vector2i picture, int border) const {
    if (unbounded_) return {.size = picture};
    PixelBox box;
    for (int axis = 0; axis < 2; ++axis) {
      const int last = picture[axis];
      const auto pixel = [last](double place) {
        return static_cast<int>(std::clamp(0.5 * (place + 1) * last, -1e6, 1e6));
      };
      box.corner[axis] = std::clamp(pixel(low_[axis]) - border, 0, last);
      box.size[axis] = std::clamp(pixel(high_[axis]) + 1 + border, 0, last) - box.corner[axis];
    }
    return box;
  }

 private:
  Eigen::Matrix4d to_clip_;
  Eigen::Array2d low_ = Eigen::Array2d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Array2d high_ = -low_;
  bool unbounded_ = false;
};

/// Returns the corners of the cube around a sphere.
Vertices cube(const Eigen::Vector4f& sphere) {
  Vertices corners(8, 3);
  for (int corner = 0; corner < 8; ++corner) {
    for (int axis = 0; axis < 3; ++axis) {
      corners(corner, axis) = double{sphere[axis]} + ((corner >> axis & 1) != 0 ? 1 : -1) * double{sphere[3]};
    }
  }
  return corners;
}

/// Pixels added on each side: OpenGL rounds vertices to single precision and to 1/256 pixel.
constexpr int border = 1;

}  // namespace

PixelBox covered_box(const Shot& shot, const Vertices& cloth, Eigen::Vector2i picture) {
  if (!shot.grounds.empty()) return {.size = picture};
  Outline outline(shot);
  outline.add(cloth);
  for (const Eigen::Vector4f& sphere : shot.spheres) outline.add(cube(sphere));
  for (const MeshShape* body : shot.bodies) outline.add(body->positions);
  return outline.box(picture, border);
}

PixelBox box_around(const Shot& shot, const Vertices& points, Eigen::Vector2i picture) {
  if (points.rows() == 0) return {};
  Outline outline(shot);
  outline.add(points);
  return outline.box(picture, border);
}

}  // namespace drape
