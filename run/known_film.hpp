#pragma once

#include "render/camera_path.hpp"
#include "scene/scene.hpp"

namespace drape {

/// What the camera of a scene has to know of its film.
/// @param size  of the pictures [pixels]
/// @param count of the frames
/// @param pass  see KnownFilm::pass; not called where the camera needs no motion
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
