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

/// The vertices of a mesh as they are drawn: one for each smooth part of the surface around it, as triangles that meet
/// at a crease have normals of their own.
struct CreasedMesh {
  std::vector<int> sources;         ///< of each drawn vertex, which of the mesh it is
  std::vector<Triangle> triangles;  ///< of drawn vertices, in the order of the mesh

  /// Parts at all edges where the normals of two triangles are more than this apart, in the given place.
  static constexpr double crease = 35;  ///< [degrees]
  CreasedMesh(const std::vector<Triangle>& mesh, const Vertices& positions);
};

/// Draws bodies: dull, smooth where their meshes are smooth, and with two sides.
class DrawBody {
 public:
  /// @param sphere_count,ground_count in every frame, as of spheres; what is below the grounds is not drawn
  DrawBody(GlDevice& device, const Look& look, std::size_t sphere_count, std::size_t ground_count);

  /// @param shadow of the frame, where the look has shadows
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
  std::vector<std::unique_ptr<Drawn>> drawn_;  // by the bodies' order; made when a frame first has them
  std::vector<float> floats_;                  // of each drawn vertex: position and normal
};

}  // namespace drape
