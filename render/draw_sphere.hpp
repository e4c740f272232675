#pragma once

#include <Eigen/Core>
#include <cstddef>

#include "render/cloth_shadow.hpp"
#include "render/gl/device.hpp"
#include "render/gl/objects.hpp"
#include "render/settings.hpp"
#include "render/shot.hpp"

namespace drape {

/// Draws the spheres: smooth and glossy. It draws only the visible cap of each, whose rim is the exact outline, so that
/// multisampling gives clean edges.
class DrawSphere {
 public:
  /// @param sphere_count number of spheres in every frame
  /// @param ground_count number of grounds visible in every frame; parts below them are not drawn
  DrawSphere(GlDevice& device, const Look& look, std::size_t sphere_count, std::size_t ground_count);

  /// @param shadow shadow map of the cloth, if the look has shadows
  void draw(const Shot& shot, const ClothShadow* shadow);

 private:
  const GlFunctions& gl_;
  const Program& program_;
  Eigen::Vector3f color_;  // linear
  VertexArray array_;
  Buffer vertex_buffer_, index_buffer_;
  GLsizei index_count_ = 0;
};

}  // namespace drape
