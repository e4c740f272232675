#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "render/shot.hpp"
#include "sim/mesh.hpp"

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
};

}  // namespace drape
