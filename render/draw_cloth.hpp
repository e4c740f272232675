#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "render/ambient_occlusion.hpp"
#include "render/cloth_shadow.hpp"
#include "render/gl/device.hpp"
#include "render/gl/objects.hpp"
#include "render/hem.hpp"
#include "render/occluders.hpp"
#include "render/settings.hpp"
#include "render/shot.hpp"
#include "render/smooth_surface.hpp"
#include "sim/mesh.hpp"

namespace drape {

/// Draws the cloth: its smooth surface with a hem, lit on both sides, in its texture or its colour, with or without
/// mesh lines.
class DrawCloth {
 public:
  /// Parameters and exceptions are Renderer's.
  DrawCloth(GlDevice& device, const Look& look, Eigen::Vector2i size, const std::vector<Triangle>& triangles,
            const std::vector<std::array<float, 2>>& uvs);

  /// Computes the shape of a frame, which is drawn next.
  void shape(const Frame& frame);
  /// Triangles of the surface, without the hem.
  [[nodiscard]] const std::vector<Triangle>& triangles() const { return surface_.triangles(); }
  /// Positions of the vertices of surface and hem.
  [[nodiscard]] const Vertices& positions() const { return positions_; }

  /// @param shadow of the frame, where the look has shadows
  /// @param colors of the cloth's vertices, in place of texture and colour; or none
  void draw(const Shot& shot, const ClothShadow* shadow, std::span<const Rgb> colors = {});

 private:
  /// What of a GL vertex stays the same in all frames.
  struct Corner {
    std::array<float, 2> uv{};
    std::array<float, 3> barycentric{};  // of the mesh lines
    std::array<float, 3> line_scale{};   // 1 for an edge of two triangles, which draw one half of the line each, else 2
  };

  /// The place of a GL vertex: its vertex of the surface, and where that is in a triangle of the cloth.
  struct Source {
    int vertex;
    Triangle corners;
    std::array<float, 3> weights;
  };

  void load_texture();
  void make_corners(const std::vector<std::array<float, 2>>& uvs);
  void add_hem(std::vector<Corner>& corners);
  void upload_corners(const std::vector<Corner>& corners);
  void upload_shape();
  void upload_occlusion(const Shot& shot);
  void upload_colors(std::span<const Rgb> colors);
  void upload_indices(const ClothShadow& shadow);
  void find_programs(std::size_t sphere_count, bool colored);
  const Program* find_program(ClothShadow::Light light) const;
  void set_uniforms(const Program& program) const;

  GlDevice& device_;
  const GlFunctions& gl_;
  Look look_;
  std::vector<Triangle> triangles_;
  SmoothSurface surface_;
  Hem hem_;
  Vertices positions_, normals_;
  Occluders occluders_;          // of the sky
  std::vector<Source> sources_;  // of each GL vertex
  std::vector<float> dynamic_;   // of each GL vertex: position and normal
  VertexArray array_;
  Buffer static_buffer_, dynamic_buffer_, index_buffer_;
  std::optional<Buffer> color_buffer_;  // made when vertices first have colours
  std::optional<Buffer> occlusion_buffer_;
  std::optional<AmbientOcclusion> occlusion_;  // with its buffer: absent where the look has none
  std::optional<Texture> texture_;
  std::vector<unsigned> indices_;             // of the corners of all triangles
  std::array<std::size_t, 4> counts_{};       // triangles in each light, as they follow each other in the index buffer
  std::array<const Program*, 4> programs_{};  // likewise; without shadows only the first is there
  std::size_t sphere_count_ = 0;
  bool colored_ = false;
};

}  // namespace drape
