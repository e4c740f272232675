#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "drape/render/settings.hpp"
#include "drape/render/view.hpp"
#include "drape/sim/mesh.hpp"

namespace drape {

/// A film with known motion, as a camera needs it.
struct KnownFilm {
  double aspect;  ///< width of the picture by its height
  double fps;     ///< frames per second
  int count;      ///< number of frames, at least 1
  const std::vector<Triangle>& triangles;
  const Vertices& start;  ///< positions at the scene's start, n×3 [m]
  const Look& look;       ///< position of the key light
  /// Calls its argument for each frame in order. May be called several times.
  std::function<void(const std::function<void(const Frame&)>&)> pass;
};

/// The camera's view in every frame of a film, numbered from its first frame.
class CameraPath {
 public:
  /// Makes a path whose camera stays.
  CameraPath(const View& view) : views_{view} {}  // NOLINT(google-explicit-constructor): a view is a path
  /// @param views one per frame
  explicit CameraPath(std::vector<View> views) : views_(std::move(views)) {}

  [[nodiscard]] const View& at(int frame) const {
    return views_.size() == 1 ? views_.front() : views_.at(static_cast<std::size_t>(frame));
  }

 private:
  std::vector<View> views_;
};

/// The evenly spread frames of a film by which well_placed() judges directions.
class SampledFrames {
 public:
  /// @param count     number of the film's frames
  /// @param triangles number of the cloth's triangles: a large mesh gets fewer frames
  SampledFrames(int count, std::size_t triangles);

  /// Takes the film's next frame.
  void add(const Frame& frame);

  [[nodiscard]] const std::vector<Frame>& frames() const { return frames_; }

 private:
  int count_, most_, index_ = 0;
  std::vector<Frame> frames_;
};

/// Completes a camera's azimuth and elevation. If one is absent, it takes the best of a few directions, judged by small
/// depth-buffered pictures of some frames that hold the whole motion:
///  - the area of the cloth, more if the key light falls on it, a little less for its back;
///  - the visible fraction of each sphere;
///  - the distance that vertices move across the picture.
/// The default direction wins a tie. Directions from below a ground are left out.
Camera well_placed(const Camera& camera, const KnownFilm& film);

/// Returns the camera's view in every frame of a film. Everything is in view with the camera's margin, in every frame.
///
/// A fixed camera is placed as by Framing. With `orbit` it circles the target, or the middle of the motion, at constant
/// distance; frame k of n is turned by k/n of the angle, so a repeated film turns on without a jump. With `follow` its
/// target is the middle of the frame's objects, at the least distance. Both are averaged over the second before and
/// after, with weights that fall to zero; the distance first takes its maximum over that time. So nothing leaves the
/// picture, and the path is smooth: with W frames in a second, its second difference is at most 2/W² of its range.
CameraPath camera_path(const Camera& camera, const KnownFilm& film);

}  // namespace drape
