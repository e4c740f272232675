#pragma once

#include <Eigen/Core>

#include "render/shot.hpp"

namespace drape {

/// A rectangle of pixels, with its corner counted from the lower left.
struct PixelBox {
  Eigen::Vector2i corner{0, 0};
  Eigen::Vector2i size{0, 0};

  [[nodiscard]] bool empty() const { return size.minCoeff() <= 0; }
};

/// Returns a box with every pixel that the shot may cover; all pixels outside are background. With a ground, or with
/// an object beside or behind the camera, it is the whole picture.
/// @param cloth   drawn vertices of the cloth
/// @param picture width and height [pixels]
PixelBox covered_box(const Shot& shot, const Vertices& cloth, Eigen::Vector2i picture);

/// Returns a box with every pixel of the convex hull of the points; empty without points.
PixelBox box_around(const Shot& shot, const Vertices& points, Eigen::Vector2i picture);

}  // namespace drape
