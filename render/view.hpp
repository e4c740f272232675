#pragma once

// Example:
//   drape::Framing framing(drape::Camera{.azimuth = -60, .elevation = 20}, 480.0 / 400);
//   framing.add(drape::make_grid(20, 20).positions);
//   const drape::View view = framing.view();  // all of it is in the picture

#include <Eigen/Core>
#include <array>
#include <vector>

#include "render/settings.hpp"
#include "sim/frame.hpp"

namespace drape {

/// The near and far clipping distances from the camera's plane [m], 0 < near < far.
struct DepthRange {
  double near = 0.1, far = 100;
};

/// A perspective camera with all of its parameters known.
struct View {
  Eigen::Vector3d position{0, 0, 1};  ///< [m]
  Eigen::Vector3d target{0, 0, 0};    ///< what is in the middle of the picture [m]
  Eigen::Vector3d up{0, 1, 0};        ///< points upwards in the picture; need not be perpendicular to the view
  double field_of_view = 30;          ///< of the picture's height [degrees]

  /// Rows: the unit vectors that point to the picture's right, to its top, and towards the viewer. Where `up` lies in
  /// the direction of the view, +y is upwards instead, or else +z.
  [[nodiscard]] Eigen::Matrix3d axes() const;

  /// From the world to the camera, which looks along its own −z.
  [[nodiscard]] Eigen::Matrix4d view_matrix() const;

  /// From the camera to clip space, as OpenGL defines it.
  /// @param aspect width of the picture by its height
  [[nodiscard]] Eigen::Matrix4d projection_matrix(double aspect, const DepthRange& depth) const;
};

/// The range that holds everything of the frame in front of the camera, with some room.
/// @param thickness of the cloth [m]
DepthRange depth_range(const View& view, const Frame& frame, double thickness = 0);

/// The view from 1 m in the direction in which a camera without a position stands, towards the origin. Where it looks
/// along its `up`, the view's is another.
View distant_view(const Camera& camera);

/// Whether the motion must be known before the camera's view is: it must unless both position and target are given.
bool needs_motion(const Camera& camera);

/// The view of a camera for which needs_motion() is false.
/// @throws std::invalid_argument if it is true
View fixed_view(const Camera& camera);

/// Calls visit(center, radius) for balls whose convex hull holds a collider: a mesh's vertices, [m]. A ground has none,
/// as it has no end: a picture shows what lies on it.
template <class Visit>
void for_each_ball(const Collider& collider, const Visit& visit) {
  if (const auto* sphere = std::get_if<SphereShape>(&collider)) visit(sphere->center, sphere->radius);
  if (const auto* mesh = std::get_if<MeshShape>(&collider)) {
    for (const auto& x : mesh->positions.rowwise()) visit(Eigen::Vector3d(x.transpose()), 0.0);
  }
}

/// Finds the view that shows a whole motion, from a camera whose direction is known and whose place is not.
///
/// A point p is inside a perspective frustum if it is on the inner side of four planes, n_k·p ≤ n_k·e for a camera at
/// e, whose unit normals n_k are known. So of the whole motion only the four maxima of n_k·p have to be kept (a sphere
/// adds its radius), and the nearest e that fulfils all is exact, not an estimate from a bounding box. The maxima for
/// narrower frustums tell how to centre the axis in which there is space left over.
class Framing {
 public:
  /// @param aspect width of the picture by its height
  Framing(const Camera& camera, double aspect);

  void add(const Vertices& positions);
  /// A ground, which has no end, is not added.
  void add(const Collider& collider);
  /// What was added since the last call belongs to one frame. Needed where the camera may leave something outside.
  void end_frame();

  /// Of the box around everything added; where something may be outside, the median of the frames'. [m]
  [[nodiscard]] Eigen::Vector3d middle() const;

  /// Whether nothing has been added.
  [[nodiscard]] bool empty() const { return middles_.empty() && lowest_[0] > highest_[0]; }

  /// The view in which everything added is inside with the camera's margin, and as large as that allows; with
  /// `outside`, on each side of the picture, in all frames but the part that reach farthest there. Without a target the
  /// space that is left over, in one of the two axes, is the same on both sides. A camera with a position stays there
  /// and turns to its target, or else to the middle of the motion.
  /// @throws std::logic_error if nothing has been added
  [[nodiscard]] View view() const;

 private:
  static constexpr int widths = 64;
  using Widths = Eigen::Array<double, widths, 1>;

  /// The planes on both sides of the view, horizontally or vertically, of frustums from very narrow to the free one.
  struct Fan {
    Widths cosines, sines;  // of half the opening angle, ascending
    Widths upper, lower;    // the largest n·p for the planes at the right or the top, at the left or the bottom
  };

  void add_ball(const Eigen::Vector3d& center, double radius);
  [[nodiscard]] std::array<Fan, 2> without_farthest() const;

  Camera camera_;
  Eigen::Matrix3d axes_;                    // as View::axes(), of a camera without a position
  std::array<Fan, 2> fans_;                 // horizontal, vertical
  std::vector<Eigen::Vector3d> middles_;    // of each frame, where something may be outside
  std::vector<std::array<Fan, 2>> frames_;  // likewise; fans_ is of the next one
  Eigen::Vector3d lowest_, highest_;        // the bounding box
};

}  // namespace drape
