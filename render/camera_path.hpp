#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "render/settings.hpp"
#include "render/view.hpp"
#include "sim/mesh.hpp"

namespace drape {

/// A film whose motion is known, as far as a camera has to know it.
struct KnownFilm {
  double aspect;  ///< width of the picture by its height
  double fps;     ///< frames per second
  int count;      ///< of its frames, at least 1
  const std::vector<Triangle>& triangles;
  const Look& look;  ///< where the key light stands
  /// Calls what it is given for each frame, from the first to the last. Can be gone through several times.
  std::function<void(const std::function<void(const Frame&)>&)> pass;
};

/// Where the camera is in every frame of a film, counted from the film's first.
class CameraPath {
 public:
  /// It stays.
  CameraPath(const View& view) : views_{view} {}  // NOLINT(google-explicit-constructor): a view is a path
  /// @param views of every frame
  explicit CameraPath(std::vector<View> views) : views_(std::move(views)) {}

  [[nodiscard]] const View& at(int frame) const {
    return views_.size() == 1 ? views_.front() : views_.at(static_cast<std::size_t>(frame));
  }

 private:
  std::vector<View> views_;
};

/// The camera with azimuth and elevation: where one of them is absent, that of a few directions which shows most. Each
/// is looked at in some frames, in a small picture with everything's true depth:
///  - how much of the picture the cloth covers, the more the better the key light falls on it, and its back a little
///    less, if all of the motion has to fit;
///  - how much of each sphere is seen, of what would be seen if it stood alone;
///  - how far vertices move across the picture.
/// Nothing else being equal, the usual direction is the best. Directions from below a ground are left out.
Camera well_placed(const Camera& camera, const KnownFilm& film);

/// Where a camera is in every frame of a film. Everything is in view with the camera's margin, in every frame.
///
/// One that stays stands as Framing says. With `orbit` it goes round the target, or the middle of the motion, at a
/// distance that does not change; frame k of n is turned by k/n of the angle, so that a film that repeats goes on
/// turning. With `follow` its target is where the middle of things is, and it is as near as it can be; both are
/// averaged over the second before and the second after with weights that fall off to nothing, the distance after the
/// largest of that time was taken for each moment. So nothing leaves the picture, and the way has no jerks: with W
/// frames in a second, its second difference is at most 2/W² of all the way there is.
CameraPath camera_path(const Camera& camera, const KnownFilm& film);

}  // namespace drape
