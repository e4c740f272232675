#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "drape/sim/mesh.hpp"
#include "render/shot.hpp"

namespace drape {

/// A piece of a line at which a picture may change abruptly. Its ends are columns and rows, in pixels from the lower
/// left corner, and depths, 0 to 1.
struct OutlineSegment {
  Eigen::Vector3d from, to;
};

/// Projects points into a picture. Rounds columns and rows to 1/256 pixel as OpenGL does, so that a pixel's middle is
/// on the same side of an edge for both.
class Projection {
 public:
  Projection(const Shot& shot, Eigen::Vector2i picture);

  /// Returns column, row and depth of a point; not finite for a point beside or behind the camera.
  [[nodiscard]] Eigen::Vector3d point(const Eigen::Vector3d& x) const;
  /// Projects the rows of an n×3 matrix.
  [[nodiscard]] std::vector<Eigen::Vector3d> points(const Vertices& x) const;

 private:
  Eigen::Matrix4d to_clip_;
  Eigen::Vector2d half_;  // of the picture [pixels]
};

/// The edges of a mesh that may be part of its outline.
class MeshOutline {
 public:
  explicit MeshOutline(const std::vector<Triangle>& triangles) : MeshOutline(triangles, triangles) {}
  /// @param drawn the same triangles with vertices split along creases, which always belong to the outline
  MeshOutline(const std::vector<Triangle>& triangles, const std::vector<Triangle>& drawn);

  /// Appends the outline: edges of one triangle or more than two, creases, and edges whose two triangles lie on the
  /// same side of them in the picture.
  /// @param points the vertices in the picture
  /// @param border false: without the edges of one triangle
  void append(std::span<const Eigen::Vector3d> points, bool border, std::vector<OutlineSegment>& outline) const;

 private:
  enum class Kind { border, smooth, always };
  struct MeshEdge {
    int from, to, left, right;  // vertices: ends, and opposite ones; `right` only of a smooth edge
    Kind kind;
  };
  std::vector<MeshEdge> edges_;
};

/// Smooths the outlines in a picture of one sample per pixel. A pixel that an outline crosses takes the colour of its
/// neighbour beyond the outline for the part of the pixel that lies there (Persson 2011, "Geometric Post-process
/// Anti-Aliasing"). An outline that something nearer hides changes nothing. The part is exact but at the corners of the
/// outline.
/// @param box   the pixels, row by row from below
/// @param depth depth of each pixel, 0 to 1
/// @param rgba  four numbers per pixel
void smooth_outlines(std::span<const OutlineSegment> outline, const PixelBox& box, std::span<const float> depth,
                     std::span<std::uint16_t> rgba);

}  // namespace drape
