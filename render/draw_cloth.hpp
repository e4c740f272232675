#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "drape/render/settings.hpp"
#include "drape/sim/mesh.hpp"
#include "render/gl/device.hpp"
#include "render/gl/program.hpp"
#include "render/outline.hpp"
#include "render/shadows.hpp"
#include "render/shot.hpp"
#include "render/smooth_surface.hpp"

namespace drape {

/// The cloth's weave: yarns of a fixed width along both texture coordinates, visible from near only.
class Weave {
 public:
  static constexpr double yarn_width = 0.0008;  ///< [m]
  static constexpr double least_pixels = 3;     ///< width of a yarn in a picture below which its relief is faded out

  /// @param rest positions of the flat cloth's vertices [m]
  /// @param uvs  per triangle corner as in Mesh::uvs; without any there is no weave
  Weave(const Vertices& rest, const std::vector<Triangle>& triangles, const std::vector<std::array<float, 2>>& uvs);

  /// Returns the number of yarns in a unit of each texture coordinate; 0 if there is no weave.
  [[nodiscard]] const Eigen::Vector2f& yarns() const { return yarns_; }

  /// Returns true if yarns may be wide enough to be seen where the cloth is nearest.
  /// @param height of the picture [pixels]
  [[nodiscard]] bool visible(const Shot& shot, int height) const;

  /// Sets the weave's uniform in a program of cloth.frag that is in use.
  void set_uniform(const Program& program) const;

 private:
  Eigen::Vector2f yarns_ = Eigen::Vector2f::Zero();
  double widest_ = 0;  // yarn, where the coordinates are stretched most [m]
};

/// Ratio of a pixel's footprint in a texture, length by width, up to which one sample of the mipmap is sharp enough. As
/// in cloth.frag.
constexpr double tolerated_stretch = 1.5;

/// Returns the largest number of samples along a footprint.
/// @param anisotropy ratio up to which a footprint is resolved across
int most_footprint_samples(int anisotropy);

/// Returns the number of samples along the footprint of a pixel: 1, 2 or most_footprint_samples(). It is 1 where the
/// texture is magnified.
/// @param change of the texture coordinates per pixel along the picture's axes, as columns [texels]
int footprint_samples(const Eigen::Matrix2d& change, int anisotropy);

/// Finds the triangles that are seen so aslant that their texture needs several samples.
class TextureFootprints {
 public:
  /// @param edges texture coordinates of a triangle's second and third corner relative to its first, as columns
  ///   [texels]; zero for triangles without a texture
  TextureFootprints(std::vector<Eigen::Matrix2d> edges, int anisotropy)
      : edges_(std::move(edges)), anisotropy_(anisotropy) {}

  /// Computes footprint_samples() of each triangle, as if it were seen from afar.
  /// @param positions vertices [m]
  /// @param picture   size [pixels]
  const std::vector<int>& count(const Shot& shot, const Vertices& positions, std::span<const Triangle> triangles,
                                Eigen::Vector2i picture);

 private:
  std::vector<Eigen::Matrix2d> edges_;
  int anisotropy_;
  std::vector<int> samples_;
};

/// Draws the cloth: its smooth surface with a hem, lit on both sides, with optional mesh lines. Each of several cloths
/// has its own texture or colour.
class DrawCloth {
 public:
  /// Takes the parameters of Renderer and throws its exceptions.
  DrawCloth(GlDevice& device, const Look& look, Eigen::Vector2i size, const std::vector<Triangle>& triangles,
            const std::vector<std::array<float, 2>>& uvs);

  /// Draws a weave from now on, where it can be seen. Takes the parameters of Renderer::set_weave().
  void set_weave(const Vertices& rest, const std::vector<std::array<float, 2>>& uvs) {
    weave_.emplace(rest, triangles_, uvs);
  }

  /// Computes the surface of the next frame to draw. Uses no OpenGL, as prepare().
  void shape(const Frame& frame);
  /// Triangles of the surface, without the hem.
  [[nodiscard]] const std::vector<Triangle>& triangles() const { return surface_.triangles(); }
  /// Positions of the vertices of surface and hem.
  [[nodiscard]] const Vertices& positions() const { return positions_; }

  /// Computes all else that draw() passes to OpenGL.
  /// @param shadow shadow map of the frame, if the look has shadows
  /// @param colors colours of the cloth's vertices, which replace texture and colour; empty: none
  void prepare(const Shot& shot, const ClothShadow* shadow, std::span<const Rgb> colors = {});

  /// Draws what was prepared, with the same arguments.
  void draw(const Shot& shot, const ClothShadow* shadow);

  /// Appends the outline of what prepare() prepared.
  void append_outline(const Projection& project, std::vector<OutlineSegment>& outline) const;

 private:
  static constexpr std::size_t kinds_of_light = 4;
  static constexpr std::size_t kinds_of_samples = 3;  // of the texture: one, two or most_footprint_samples()
  static constexpr std::size_t kinds = kinds_of_light * kinds_of_samples;

  /// A cloth with one texture or colour.
  struct Painted {
    int first_triangle;  // of the mesh
    Rgb color;
    std::optional<Texture> texture;
    Eigen::Vector2d texture_size{0, 0};               // [texels]
    bool woven = true;                                // has texture coordinates, which a weave needs
    std::array<std::size_t, kinds> counts{};          // triangles per kind of samples and light, in the index buffer
    std::array<const Program*, kinds> programs = {};  // likewise; null until used
  };

  /// Attributes of a GL vertex that are the same in all frames.
  struct Corner {
    std::array<float, 2> uv{};
    std::array<float, 3> barycentric{};  // for the mesh lines
    std::array<float, 3> line_scale{};   // 1 for an edge of two triangles, each of which draws half of the line; else 2
  };

  /// Origin of a GL vertex: its vertex of the surface, and its position in a triangle of the cloth.
  struct Source {
    int vertex;
    Triangle corners;
    std::array<float, 3> weights;
  };

  void paint(const ClothLook& look, const std::vector<std::array<float, 2>>& uvs);
  /// @param repeating per texture coordinate: true if the texture repeats, false if it ends at 0 and 1
  void load_texture(Painted& cloth, const std::filesystem::path& file, const std::array<bool, 2>& repeating) const;
  /// Returns the number of the cloth that a triangle of the mesh belongs to.
  [[nodiscard]] std::size_t painted_at(int triangle) const;
  void make_corners(const std::vector<std::array<float, 2>>& uvs);
  void find_footprints(const std::vector<Corner>& corners);
  void add_hem(std::vector<Corner>& corners);
  void upload_corners(const std::vector<Corner>& corners);
  void find_occlusion(const Shot& shot);
  void find_colors(std::span<const Rgb> colors);
  /// @param shadow null: no shadows
  void sort_triangles(const Shot& shot, const ClothShadow* shadow);
  void upload();
  /// Fills the buffer of an attribute with `size` numbers per vertex.
  void upload(const Buffer& buffer, GLuint attribute, GLint size, const std::vector<float>& numbers);
  void choose_programs(std::size_t sphere_count, bool colored, bool woven);
  [[nodiscard]] const Program* find_program(const Painted& cloth, std::size_t kind) const;
  void set_uniforms(const Painted& cloth, const Program& program) const;

  GlDevice& device_;
  const GlFunctions& gl_;
  Look look_;
  std::vector<Triangle> triangles_;
  SmoothSurface surface_;
  Hem hem_;
  bool hemmed_ = false;  // true if the frame shows the hem
  MeshOutline outline_, hem_outline_;
  Vertices positions_, normals_;
  Occluders occluders_;          // of ambient light
  std::vector<Source> sources_;  // per GL vertex
  std::vector<float> dynamic_;   // position and normal of each GL vertex
  std::vector<float> open_;      // light that reaches the sides of each GL vertex; empty without ambient occlusion
  std::vector<float> linear_;    // colour of each GL vertex; empty if the vertices have none
  VertexArray array_;
  Buffer static_buffer_, dynamic_buffer_, index_buffer_;
  std::optional<Buffer> color_buffer_;  // made when vertices first have colours
  std::optional<Buffer> occlusion_buffer_;
  std::optional<AmbientOcclusion> occlusion_;    // and its buffer: absent if the look has none
  std::vector<Painted> painted_;                 // in the order of the triangles
  std::vector<unsigned> indices_;                // corners of all triangles
  std::vector<unsigned> sorted_;                 // the same in the order of drawing; empty if that is any
  std::optional<TextureFootprints> footprints_;  // absent without textures or anisotropy
  std::size_t sphere_count_ = 0;
  bool colored_ = false, woven_ = false;
  std::optional<Weave> weave_;
  Eigen::Vector2i size_;  // of the picture [pixels]
};

}  // namespace drape
