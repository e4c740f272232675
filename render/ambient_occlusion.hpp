#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "render/depth_map.hpp"
#include "sim/mesh.hpp"

namespace drape {

/// How much of the light from all around the cloth itself, and what is beside it, leaves to each of its vertices. Light
/// comes in from the 14 directions of Lebedev's quadrature of degree 5 (to the faces and corners of a cube), by
/// Lambert's cosine; from which of them a vertex is hidden say maps of the cloth as it is seen along each, every one of
/// which serves both its ends.
class AmbientOcclusion {
 public:
  AmbientOcclusion();

  /// Of a vertex's front and back: the part of the light, 1 where nothing is hidden.
  using Sides = std::array<float, 2>;

  /// @param normals as vertex_normals(), of the cloth's vertices, which come first in `positions`
  /// @param texel   width of the maps' texels [m]: details that are smaller are not seen
  const std::vector<Sides>& compute(const Vertices& positions, const Vertices& normals,
                                    const std::vector<Triangle>& triangles, double texel);

 private:
  struct Axis {
    Eigen::Vector3d direction;
    float weight;  // of each of its two ends
    DepthMap map;
  };

  void gather(const Axis& axis, const Vertices& normals);

  void smooth(const std::vector<Triangle>& triangles);

  std::vector<Axis> axes_;
  std::vector<Sides> reached_, whole_;  // light of each vertex, with and without the cloth
};

}  // namespace drape
