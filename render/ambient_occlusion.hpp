#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "drape/sim/mesh.hpp"
#include "render/shadows.hpp"

namespace drape {

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
