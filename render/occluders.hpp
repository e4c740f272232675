#pragma once

#include <vector>

#include "sim/frame.hpp"

namespace drape {

/// What throws shadows and hides the sky: the cloth, and after its vertices those of all bodies, as one mesh. Without
/// bodies it is the cloth itself, of which nothing is copied.
class Occluders {
 public:
  /// @param cloth its triangles, which must outlive this object
  explicit Occluders(const std::vector<Triangle>& cloth) : cloth_(cloth) {}

  /// @param cloth its positions; it and the frame must outlive what is asked of this object
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
