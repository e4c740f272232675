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

  /// Which part of the key light reaches a triangle: all of it, what spheres leave, what cloth, bodies and spheres
  /// leave, or none.
  enum class Light { whole, past_spheres, past_cloth, none };

  /// @param rows of the picture [pixels]
  ClothShadow(const GlFunctions& gl, int rows);

  /// Draws the map of a frame.
  void cast(const Shot& shot, const Occluders& occluders);

  [[nodiscard]] const DepthMap& map() const { return map_; }

  /// Classifies a triangle of the cloth. Most have no shadow of cloth, body or sphere on them.
  [[nodiscard]] Light light_on(const Triangle& triangle) const;

  /// Hands the map to a program that is in use.
  void set_uniforms(const Program& program) const;

 private:
  /// Columns and rows of the map, the last included.
  struct Texels {
    int left, right, bottom, top;
  };

  void find_layers();
  [[nodiscard]] bool has_layers(const Texels& texels) const;
  [[nodiscard]] Light past_cloth(const Triangle& triangle) const;
  [[nodiscard]] bool is_behind_a_sphere(const Triangle& triangle) const;

  const GlFunctions& gl_;
  double resolution_;  // texels across what the picture shows
  DepthMap map_;
  Texture texture_;
  Eigen::Vector2i size_{0, 0};            // of the texture
  std::vector<Eigen::Vector4d> spheres_;  // place in the map, and radius [m]
  std::vector<unsigned char> layered_;    // of each block: whether one thing is behind another there
};

}  // namespace drape
