#pragma once

// Example:
//   drape::Framing framing(drape::Camera{.azimuth = -60, .elevation = 20}, 480.0 / 400);
//   framing.add(drape::make_grid(20, 20).positions);
//   const drape::View view = framing.view();  // all of it is in the picture

#include <Eigen/Core>
#include <array>
#include <vector>

#include "drape/render/settings.hpp"
#include "drape/sim/state.hpp"

namespace drape {

/// The near and far clipping distances from the camera's plane [m], 0 < near < far.
struct DepthRange {
  double near = 0.1, far = 100;
};

/// A perspective camera with all parameters known.
struct View {
  Eigen::Vector3d position{0, 0, 1};  ///< [m]
  Eigen::Vector3d target{0, 0, 0};    ///< point in the middle of the picture [m]
  Eigen::Vector3d up{0, 1, 0};        ///< points upwards in the picture; need not be perpendicular to the view
  double field_of_view = 30;          ///< vertical field of view [degrees]

  /// Returns the camera's unit axes as rows: right, up, and towards the viewer. If `up` is parallel to the view, +y
  /// replaces it, or else +z.
  [[nodiscard]] Eigen::Matrix3d axes() const;

  /// Returns the transformation from the world to the camera, which looks along its own −z.
  [[nodiscard]] Eigen::Matrix4d view_matrix() const;

  /// Returns the projection from the camera to OpenGL's clip space.
  /// @param aspect width / height of the picture
  [[nodiscard]] Eigen::Matrix4d projection_matrix(double aspect, const DepthRange& depth) const;
};

/// Returns the depth range of all the frame's objects in front of the camera, with a margin.
/// @param thickness thickness of the cloth [m]
DepthRange depth_range(const View& view, const Frame& frame, double thickness = 0);

/// Returns a view of the origin from 1 m away, in the direction of a camera without a position. If that camera looks
/// along its `up`, the view gets another up.
View distant_view(const Camera& camera);

/// Returns true if the camera's position or target must be computed from the motion.
bool needs_motion(const Camera& camera);

/// Returns the view of a camera for which needs_motion() is false. A target that only gives the direction, far in front
/// of the cloth or behind it, is moved along the view to the cloth's middle, unless the camera circles it: shadows and
/// a backdrop's floor are made for its distance.
/// @param start the cloth at the scene's start, n×3 [m]
/// @throws std::invalid_argument if needs_motion() is true
View fixed_view(const Camera& camera, const Vertices& start);

/// Calls visit(center, radius) for balls whose convex hull contains the collider [m]. A mesh yields its vertices with
/// radius 0, an infinite ground nothing.
template <class Visit>
void for_each_ball(const Collider& collider, const Visit& visit) {
  if (const auto* sphere = std::get_if<SphereShape>(&collider)) visit(sphere->center, sphere->radius);
  if (const auto* mesh = std::get_if<MeshShape>(&collider)) {
    for (const auto& x : mesh->positions.rowwise()) visit(Eigen::Vector3d(x.transpose()), 0.0);
  }
}

/// Finds the nearest view in a known direction that shows a whole motion.
///
/// A camera at e sees p if n_k·p ≤ n_k·e for the four planes of its frustum. Their unit normals n_k are known. So four
/// maxima of n_k·p over the motion determine the nearest e (a sphere adds its radius). The result is exact, unlike an
/// estimate from a bounding box. Maxima for narrower frustums centre the motion along the axis with free space.
class Framing {
 public:
  /// @param aspect width / height of the picture
  Framing(const Camera& camera, double aspect);

  void add(const Vertices& positions);
  /// Adds a collider; ignores a ground, which is infinite.
  void add(const Collider& collider);
  /// Ends a frame, which holds all objects added since the last call. Needed if the camera has `outside`.
  void end_frame();

  /// Returns the centre of the bounding box; with `outside`, the median over the frames [m].
  [[nodiscard]] Eigen::Vector3d middle() const;

  /// Returns true if nothing has been added.
  [[nodiscard]] bool empty() const { return middles_.empty() && lowest_[0] > highest_[0]; }

  /// Returns the closest view of all added objects, with the camera's margin. With `outside`, each side of the picture
  /// may cut off that fraction of the frames, the farthest-reaching ones. Without a target, free space in one of the
  /// two axes is split equally. A camera with a position keeps it and turns to its target, or else to the middle of the
  /// motion.
  /// @throws std::logic_error if nothing has been added
  [[nodiscard]] View view() const;

 private:
  static constexpr int widths = 64;
  using Widths = Eigen::Array<double, widths, 1>;

  /// Two opposite side planes, horizontal or vertical, of nested frustums from very narrow to full.
  struct Fan {
    Widths cosines, sines;  // of half the opening angle, ascending
    Widths upper, lower;    // largest n·p for the right or top planes, and for the left or bottom planes
  };

  void add_ball(const Eigen::Vector3d& center, double radius);
  [[nodiscard]] std::array<Fan, 2> without_farthest() const;

  Camera camera_;
  Eigen::Matrix3d axes_;                    // as View::axes(), of a camera without a position
  std::array<Fan, 2> fans_;                 // horizontal, vertical
  std::vector<Eigen::Vector3d> middles_;    // per frame, with `outside`
  std::vector<std::array<Fan, 2>> frames_;  // per finished frame, with `outside`; fans_ is of the current frame
  Eigen::Vector3d lowest_, highest_;        // the bounding box
};

}  // namespace drape
