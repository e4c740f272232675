#pragma once

#include <vector>

#include "sim/frame.hpp"

namespace drape {

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

}  // namespace drape
