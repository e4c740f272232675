#pragma once

#include <filesystem>
#include <vector>

#include "render/gl/objects.hpp"
#include "render/gl/program.hpp"
#include "render/ground_shadow.hpp"
#include "render/settings.hpp"
#include "render/shot.hpp"

namespace drape {

/// Draws the grounds: planes without an end that fade into the background far from the middle of the picture, with a
/// grid of thin lines and the shadows of the cloth and the spheres. From below they are not seen.
class DrawGround {
 public:
  /// @param sphere_count in every frame
  DrawGround(const GlFunctions& gl, const std::filesystem::path& data_folder, const Look& look,
             const std::vector<Triangle>& triangles, std::size_t sphere_count);

  void draw(const Shot& shot);

 private:
  const GlFunctions& gl_;
  Program program_;
  VertexArray array_;  // without attributes: the shader knows the corners of the picture
  Texture texture_;
  GroundShadow shadow_;
};

}  // namespace drape
