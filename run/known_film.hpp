#pragma once

#include "render/camera_path.hpp"
#include "scene/scene.hpp"

namespace drape {

/// Returns the properties of a scene's film that its camera needs.
/// @param size  of the pictures [pixels]
/// @param count number of frames
/// @param pass  see KnownFilm::pass; called only if the camera needs the motion
inline KnownFilm known_film(const Scene& scene, const Eigen::Vector2i& size, int count,
                            decltype(KnownFilm::pass) pass) {
  return {.aspect = static_cast<double>(size.x()) / size.y(),
          .fps = scene.video.fps,
          .count = count,
          .triangles = scene.simulation.cloth.triangles,
          .look = scene.look,
          .pass = std::move(pass)};
}

}  // namespace drape
