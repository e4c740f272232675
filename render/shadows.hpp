#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "drape/sim/mesh.hpp"
#include "drape/sim/state.hpp"
#include "render/gl/program.hpp"
#include "render/shot.hpp"

namespace drape {

/// Orthographic view of a cloth along one direction: depths of the nearest and the farthest surface in each texel. The
/// grid of texels is fixed in space, however the cloth moves or grows, so results do not flicker between frames. It is
/// drawn here and not by OpenGL, so that its bits are the same everywhere. Neighbouring triangles leave no gap and do
/// not overlap.
class DepthMap {
 public:
  /// Columns and rows come in blocks of this many texels, also fixed in space; the outermost texels are empty.
  static constexpr int block = 16;

  /// @param towards unit vector from the cloth to the viewer
  /// @param up      approximate direction of growing rows; a mirrored scene mirrors both vectors
  void look(const Eigen::Vector3d& towards, const Eigen::Vector3d& up);

  /// Draws the map. It stays empty if a number is not finite, or too large or small relative to the others.
  /// @param texel width of a texel [m]; doubled until no side has more than `largest` of them
  void draw(const Vertices& positions, const std::vector<Triangle>& triangles, double texel, int largest);

  /// Number of columns; 0 for an empty map.
  [[nodiscard]] int columns() const { return columns_; }
  [[nodiscard]] int rows() const { return rows_; }
  [[nodiscard]] double texel() const { return texel_; }  ///< [m]

  /// Depth of the nearest surface in each texel [m], row by row: height towards the viewer above the cloth's lowest
  /// point. Empty texels hold minus one block's width.
  [[nodiscard]] const std::vector<float>& nearest() const { return nearest_; }
  /// Depth of the farthest surface [m]. Empty texels hold a block's width above the highest point.
  [[nodiscard]] const std::vector<float>& farthest() const { return farthest_; }

  /// Column, row and depth of each vertex.
  using Places = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;
  [[nodiscard]] const Places& places() const { return projected_; }

  /// Coefficients of a point p's column u·(p, 1), row v·(p, 1) and depth(p) = depth·(p, 1). Texel k covers columns k to
  /// k+1.
  [[nodiscard]] const Eigen::Vector4d& u() const { return u_; }
  [[nodiscard]] const Eigen::Vector4d& v() const { return v_; }
  [[nodiscard]] const Eigen::Vector4d& depth() const { return depth_; }

 private:
  bool place(double texel, int largest);
  void fill(const Triangle& triangle);

  Eigen::Matrix3d axes_ = Eigen::Matrix3d::Identity();  // rows: directions of growing columns, rows and depths
  Places projected_;
  double texel_ = 0;
  int columns_ = 0, rows_ = 0;
  std::vector<float> nearest_, farthest_;
  Eigen::Vector4d u_ = Eigen::Vector4d::Zero(), v_ = u_, depth_ = u_;
};

/// Interpolates a map bilinearly between the middles of its texels.
/// @param values map.nearest() or map.farthest()
/// @param column,row position within the map
float interpolated(const DepthMap& map, const std::vector<float>& values, double column, double row);

/// The mesh that casts shadows and occludes ambient light: the cloth, followed by all bodies. Without bodies it refers
/// to the cloth and copies nothing.
class Occluders {
 public:
  /// @param cloth triangles of the cloth; must outlive this object
  explicit Occluders(const std::vector<Triangle>& cloth) : cloth_(cloth) {}

  /// @param cloth positions of the cloth; cloth and frame must outlive later calls
  void take(const Vertices& cloth, const Frame& frame);

  [[nodiscard]] const Vertices& positions() const { return copied_ ? positions_ : *cloth_positions_; }
  [[nodiscard]] const std::vector<Triangle>& triangles() const { return copied_ ? triangles_ : cloth_; }

 private:
  const std::vector<Triangle>& cloth_;
  const Vertices* cloth_positions_ = nullptr;
  bool copied_ = false;
  Vertices positions_;
  std::vector<Triangle> triangles_;
};

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

  /// Draws the map of a frame. Uses no OpenGL.
  void cast(const Shot& shot, const Occluders& occluders);
  /// Passes the map to OpenGL.
  void upload();

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

/// The shadow of a cloth on a ground, as a picture seen from the light. Its edge is sharp where the cloth is near the
/// ground and soft higher up. Each point of the ground has one pixel in the picture, so edges are softened once per
/// frame instead of in every drawn pixel.
class GroundShadow {
 public:
  /// Depth below the drawn surface at which the ground starts to hide the cloth, in contact layers: a fast cloth
  /// penetrates it for a moment. Cloth and bodies cast shadows down to one texel below this depth.
  static constexpr double hidden_below = 3;

  /// Casts the shadow.
  /// @param map       depth map of the cloth, seen from the light
  /// @param to_light  unit vector; a light below the ground casts no shadow on it
  /// @param softening height of the cloth above the ground from which the shadow is mostly soft [m]
  void cast(const DepthMap& map, const GroundShape& ground, const Eigen::Vector3d& to_light, double softening);

  /// Returns true if the light reaches a ground, so that there can be a shadow.
  [[nodiscard]] static bool reaches(const GroundShape& ground, const Eigen::Vector3d& to_light);
  /// Returns the four points of the ground at the picture's corners; no shadow lies outside. Empty without a picture.
  [[nodiscard]] std::vector<Eigen::Vector3d> corners(const GroundShape& ground) const;

  [[nodiscard]] int columns() const { return columns_; }
  [[nodiscard]] int rows() const { return rows_; }
  /// Blocked part of the light, 0 to 65535, rows from below; 0 along the border.
  [[nodiscard]] const std::vector<std::uint16_t>& pixels() const { return pixels_; }
  /// Coefficients of a ground point x's texture coordinates (u·(x, 1), v·(x, 1)), 0 to 1 within the picture.
  [[nodiscard]] const Eigen::Vector4d& u() const { return u_; }
  [[nodiscard]] const Eigen::Vector4d& v() const { return v_; }

 private:
  void clear();
  void project(const DepthMap& map, const GroundShape& ground, double softening);
  void blur(std::vector<float>& image, int radius);
  void blur_columns(std::vector<float>& image, std::size_t width, std::size_t height, std::size_t radius);

  int columns_ = 0, rows_ = 0;
  std::vector<float> sharp_, soft_, scratch_, sums_;
  std::vector<std::uint16_t> pixels_;
  Eigen::Vector4d u_ = Eigen::Vector4d::Zero(), v_ = u_;
  Eigen::Vector3d light_ = Eigen::Vector3d::UnitZ();
};

/// Ambient occlusion of the cloth by itself and by bodies, at its vertices. Light arrives from the 14 directions of
/// Lebedev's quadrature of degree 5 (towards the faces and corners of a cube), weighted by Lambert's cosine. A depth
/// map along each axis decides from which directions a vertex is hidden; it serves both ends of the axis.
class AmbientOcclusion {
 public:
  AmbientOcclusion();

  /// Fraction of the light at a vertex's front and back, 1 where nothing is hidden.
  using Sides = std::array<float, 2>;

  /// @param normals as vertex_normals(), of the cloth's vertices, which come first in `positions`
  /// @param texel   width of the maps' texels [m]; smaller details are ignored
  const std::vector<Sides>& compute(const Vertices& positions, const Vertices& normals,
                                    const std::vector<Triangle>& triangles, double texel);

 private:
  struct Axis {
    Eigen::Vector3d direction;
    float weight;  // of each of the two ends
    DepthMap map;
  };

  void gather(const Axis& axis, const Vertices& normals);

  void smooth(const std::vector<Triangle>& triangles);

  std::vector<Axis> axes_;
  std::vector<Sides> reached_, whole_;  // light at each vertex, with and without the occluders
};

}  // namespace drape
