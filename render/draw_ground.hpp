#pragma once

#include "render/cloth_shadow.hpp"
#include "render/covered_box.hpp"
#include "render/gl/device.hpp"
#include "render/gl/objects.hpp"
#include "render/ground_shadow.hpp"
#include "render/settings.hpp"
#include "render/shot.hpp"

namespace drape {

/// Draws the grounds: infinite planes that fade into the background far from the middle of the picture, with a grid of
/// thin lines and the shadows of cloth and spheres. They are invisible from below.
class DrawGround {
 public:
  /// @param sphere_count number of spheres in every frame
  DrawGround(GlDevice& device, const Look& look, std::size_t sphere_count);

  /// @param shadow  shadow map of the cloth, if the look has shadows
  /// @param picture width and height [pixels]
  void draw(const Shot& shot, const ClothShadow* shadow, Eigen::Vector2i picture);

 private:
  PixelBox cast(const Shot& shot, const ClothShadow& shadow, const GroundShape& ground, Eigen::Vector2i picture);
  void draw(const Program& program, const Shot& shot, const GroundShape& ground, const PixelBox& box) const;

  const GlFunctions& gl_;
  Look look_;
  const Program* lit_;
  const Program* shadowed_ = nullptr;  // null if the look has no shadows
  VertexArray array_;                  // without attributes: the shader computes the picture's corners
  Texture texture_;
  GroundShadow shadow_;  // of the cloth, for one ground after the other
};

}  // namespace drape
