#pragma once

#include <Eigen/Core>
#include <vector>

#include "render/depth_map.hpp"
#include "render/gl/objects.hpp"
#include "render/gl/program.hpp"
#include "render/occluders.hpp"
#include "render/shot.hpp"
#include "sim/mesh.hpp"

namespace drape {

/// Shadow map of cloth and bodies in the key light, for shaders that include shadow.glsl. Spheres are left out, because
/// the shaders compute their shadows exactly.
class ClothShadow {
 public:
  static constexpr GLint texture_unit = 1;

  /// Part of the key light that reaches a triangle: all of it; all but that blocked by spheres; all but that blocked by
  /// cloth, bodies and spheres; or none.
  enum class Light { whole, past_spheres, past_cloth, none };

  /// @param rows height of the picture [pixels]
  ClothShadow(const GlFunctions& gl, int rows);

  /// Draws the map of a frame.
  void cast(const Shot& shot, const Occluders& occluders);

  [[nodiscard]] const DepthMap& map() const { return map_; }

  /// Classifies a triangle of the cloth. Most receive no shadow of cloth, body or sphere.
  [[nodiscard]] Light light_on(const Triangle& triangle) const;

  /// Passes the map to a program that is in use.
  void set_uniforms(const Program& program) const;

 private:
  /// Range of columns and rows of the map, both ends included.
  struct Texels {
    int left, right, bottom, top;
  };

  void find_layers();
  [[nodiscard]] bool has_layers(const Texels& texels) const;
  [[nodiscard]] Light past_cloth(const Triangle& triangle) const;
  [[nodiscard]] bool is_behind_a_sphere(const Triangle& triangle) const;

  const GlFunctions& gl_;
  double resolution_;  // texels across the visible part of the scene
  DepthMap map_;
  Texture texture_;
  Eigen::Vector2i size_{0, 0};            // size of the texture
  std::vector<Eigen::Vector4d> spheres_;  // position in the map, and radius [m]
  std::vector<unsigned char> layered_;    // per block: true if one surface lies behind another
};

}  // namespace drape
