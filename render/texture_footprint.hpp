#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <utility>
#include <vector>

#include "drape/sim/mesh.hpp"
#include "render/shot.hpp"

namespace drape {

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

}  // namespace drape
