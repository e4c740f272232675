#pragma once

#include <Eigen/Core>

#include "render/shot.hpp"

namespace drape {

/// A rectangle of pixels, counted from the left and from below.
struct PixelBox {
  Eigen::Vector2i corner{0, 0};
  Eigen::Vector2i size{0, 0};

  [[nodiscard]] bool empty() const { return size.minCoeff() <= 0; }
};

/// A box that holds every pixel which something of the shot may cover: what lies outside it is background. With a
/// ground, or with something beside or behind the camera, it is the whole picture.
/// @param cloth   vertices of what is drawn of it
/// @param picture its width and height [pixels]
PixelBox covered_box(const Shot& shot, const Vertices& cloth, Eigen::Vector2i picture);

/// A box that holds every pixel in which something of the convex hull of some points may be seen; of none, it is empty.
PixelBox box_around(const Shot& shot, const Vertices& points, Eigen::Vector2i picture);

}  // namespace drape
