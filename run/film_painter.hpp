#pragma once

#include <optional>
#include <string>

#include "render/camera_path.hpp"
#include "render/renderer.hpp"
#include "run/annotations.hpp"

namespace drape {

/// Painter of a film's pictures, with the scene's annotations. Lives on the thread that owns the OpenGL context.
class FilmPainter {
 public:
  /// @param annotations absent if the scene asks for none
  FilmPainter(const Scene& scene, const CameraPath& path, std::optional<Annotations>& annotations, GlBackend backend)
      : path_(path),
        annotations_(annotations),
        renderer_(data_folder(), scene.video.size, path.at(0), Annotations::look(scene),
                  scene.simulation.cloth.vertex_count(), scene.simulation.cloth.triangles, scene.uvs, backend) {
    renderer_.set_weave(scene.simulation.cloth.rest, scene.uvs);
  }

  [[nodiscard]] std::string description() const { return renderer_.description(); }

  Image paint(const Frame& frame) {
    renderer_.look_from(path_.at(frame.index));
    if (!annotations_) return renderer_.draw(frame);
    const std::vector<Rgb> colors = annotations_->colors(frame);
    return annotations_->annotate(colors.empty() ? renderer_.draw(frame) : renderer_.draw(frame, colors), frame);
  }

 private:
  const CameraPath& path_;
  std::optional<Annotations>& annotations_;
  Renderer renderer_;
};

}  // namespace drape
