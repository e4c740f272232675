#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "render/ambient_occlusion.hpp"
#include "render/cloth_shadow.hpp"
#include "render/gl/device.hpp"
#include "render/gl/objects.hpp"
#include "render/settings.hpp"
#include "render/shot.hpp"
#include "sim/mesh.hpp"

namespace drape {

/// Draws the cloth: smooth, lit on both sides, in its texture or its colour, with or without mesh lines.
class DrawCloth {
 public:
  /// Parameters and exceptions are Renderer's.
  DrawCloth(GlDevice& device, const Look& look, const std::vector<Triangle>& triangles,
            const std::vector<std::array<float, 2>>& uvs);

  /// @param shadow of the frame, where the look has shadows
  /// @param occluders of the frame: what hides the sky
  /// @param colors of the vertices, in place of texture and colour; or none
  void draw(const Shot& shot, const ClothShadow* shadow, const Occluders& occluders, std::span<const Rgb> colors = {});

  [[nodiscard]] const std::vector<Triangle>& triangles() const { return triangles_; }

 private:
  /// What of a GL vertex stays the same in all frames.
  struct Corner {
    std::array<float, 2> uv{};
    std::array<float, 3> barycentric{};  // of the mesh lines
    std::array<float, 3> line_scale{};   // 1 for an edge of two triangles, which draw one half of the line each, else 2
  };

  void load_texture();
  void make_corners(const std::vector<std::array<float, 2>>& uvs);
  void upload_frame(const Shot& shot, const Occluders& occluders);
  void upload_occlusion(const Shot& shot, const Occluders& occluders, const Vertices& normals);
  void upload_colors(std::span<const Rgb> colors);
  void upload_indices(const ClothShadow& shadow);
  void find_programs(std::size_t sphere_count, bool colored);
  const Program* find_program(bool shadowed) const;
  void set_uniforms(const Program& program) const;

  GlDevice& device_;
  const GlFunctions& gl_;
  Look look_;
  std::vector<Triangle> triangles_;
  std::vector<int> positions_;  // of each GL vertex: which vertex of the cloth it is
  std::vector<float> dynamic_;  // of each GL vertex: position and normal
  VertexArray array_;
  Buffer static_buffer_, dynamic_buffer_, index_buffer_;
  std::optional<Buffer> color_buffer_;  // made when vertices first have colours
  std::optional<Buffer> occlusion_buffer_;
  std::optional<AmbientOcclusion> occlusion_;  // with its buffer: absent where the look has none
  std::optional<Texture> texture_;
  std::vector<unsigned> indices_;  // of the corners of all triangles
  std::size_t lit_count_ = 0;      // triangles that come first in the index buffer, without a shadow of the cloth
  const Program *lit_program_ = nullptr, *shadowed_program_ = nullptr;
  std::size_t sphere_count_ = 0;
  bool colored_ = false;
};

}  // namespace drape
