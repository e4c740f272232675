#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "render/cloth_shadow.hpp"
#include "render/gl/device.hpp"
#include "render/gl/objects.hpp"
#include "render/settings.hpp"
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

 private:
  struct Drawn {
    CreasedMesh mesh;
    VertexArray array;
    Buffer vertices, indices;
    Drawn(const GlFunctions& gl, CreasedMesh m) : mesh(std::move(m)), array(gl), vertices(gl), indices(gl) {}
  };
  std::unique_ptr<Drawn> make(const MeshShape& body) const;
  void upload(const Drawn& drawn, const MeshShape& body);

  const GlFunctions& gl_;
  const Program& program_;
  Eigen::Vector3f color_;                      // linear light
  std::vector<std::unique_ptr<Drawn>> drawn_;  // in the order of the bodies; made at the first frame with bodies
  std::vector<float> floats_;                  // position and normal of each drawn vertex
};

}  // namespace drape
