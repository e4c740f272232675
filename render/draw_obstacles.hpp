#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <memory>
#include <vector>

#include "drape/render/settings.hpp"
#include "render/gl/device.hpp"
#include "render/gl/program.hpp"
#include "render/outline.hpp"
#include "render/shadows.hpp"
#include "render/shot.hpp"

namespace drape {

/// Drawn vertices of a mesh: one for each smooth part of the surface around a vertex, because triangles that meet at a
/// crease need separate normals.
struct CreasedMesh {
  std::vector<int> sources;         ///< mesh vertex of each drawn vertex
  std::vector<Triangle> triangles;  ///< of drawn vertices, in the order of the mesh

  /// Splits at edges where two triangles' normals differ by more than this angle, at the given positions.
  static constexpr double crease = 35;  ///< [degrees]
  CreasedMesh(const std::vector<Triangle>& mesh, const Vertices& positions);
};

/// Draws bodies: matt, two-sided, and smooth where their meshes are smooth.
class DrawBody {
 public:
  /// @param sphere_count,ground_count numbers in every frame; parts below a ground are not drawn
  DrawBody(GlDevice& device, const Look& look, std::size_t sphere_count, std::size_t ground_count);

  /// @param shadow shadow map of the frame, if the look has shadows
  void draw(const Shot& shot, const ClothShadow* shadow);

  /// Appends the outlines of the bodies that were drawn.
  void append_outline(const Shot& shot, const Projection& project, std::vector<OutlineSegment>& outline) const;

 private:
  struct Drawn {
    CreasedMesh mesh;
    MeshOutline outline;
    VertexArray array;
    Buffer vertices, indices;
    Drawn(const GlFunctions& gl, const MeshShape& body)
        : mesh(*body.triangles, body.positions),
          outline(*body.triangles, mesh.triangles),
          array(gl),
          vertices(gl),
          indices(gl) {}
  };
  std::unique_ptr<Drawn> make(const MeshShape& body) const;
  void upload(const Drawn& drawn, const MeshShape& body);

  const GlFunctions& gl_;
  const Program& program_;
  Eigen::Vector3f color_;                      // linear light
  std::vector<std::unique_ptr<Drawn>> drawn_;  // in the order of the bodies; made at the first frame with bodies
  std::vector<float> floats_;                  // position and normal of each drawn vertex
};

/// Draws the spheres: smooth and glossy. It draws only the visible cap of each, whose rim is the exact outline.
class DrawSphere {
 public:
  /// @param sphere_count number of spheres in every frame
  /// @param ground_count number of grounds visible in every frame; parts below them are not drawn
  DrawSphere(GlDevice& device, const Look& look, std::size_t sphere_count, std::size_t ground_count);

  /// @param shadow shadow map of the cloth, if the look has shadows
  void draw(const Shot& shot, const ClothShadow* shadow);

  /// Appends the rims of the spheres.
  static void append_outline(const Shot& shot, const Projection& project, std::vector<OutlineSegment>& outline);

 private:
  const GlFunctions& gl_;
  const Program& program_;
  Eigen::Vector3f color_;  // linear
  VertexArray array_;
  Buffer vertex_buffer_, index_buffer_;
  GLsizei index_count_ = 0;
};

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
