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

/// What cloth and bodies take of the key light: the map of it that the light sees, for the shaders that include
/// shadow.glsl. Spheres are not in it, as a shader knows their shadows exactly.
class ClothShadow {
 public:
  static constexpr GLint texture_unit = 1;

  explicit ClothShadow(const GlFunctions& gl);

  /// Draws the map of a frame.
  void cast(const Shot& shot, const Occluders& occluders);

  [[nodiscard]] const DepthMap& map() const { return map_; }

  /// Whether a triangle of the cloth may have a shadow on it, of the cloth, a body or a sphere. Most have none.
  [[nodiscard]] bool may_fall_on(const Triangle& triangle) const;

  /// Hands the map to a program that is in use.
  void set_uniforms(const Program& program) const;

 private:
  [[nodiscard]] bool is_behind_cloth(const Triangle& triangle) const;
  [[nodiscard]] bool is_behind_a_sphere(const Triangle& triangle) const;

  const GlFunctions& gl_;
  DepthMap map_;
  Texture texture_;
  Eigen::Vector2i size_{0, 0};            // of the texture
  std::vector<Eigen::Vector4d> spheres_;  // place in the map, and radius [m]
  double softness_ = 0;                   // over what distance a shadow grows to its depth [m]
};

}  // namespace drape
