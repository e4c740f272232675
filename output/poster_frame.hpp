#pragma once

#include <array>
#include <vector>

#include "sim/mesh.hpp"

namespace drape {

/// Finds the poster frame of a motion: the first of the frames in which its cloth is bent most. Bending is the sum of
/// the angles between neighbouring triangles, weighted by edge length.
class PosterFrame {
 public:
  explicit PosterFrame(const std::vector<Triangle>& triangles);

  /// Adds the next frame. Returns true if it is bent more than all before; true for the first.
  bool see(const Vertices& positions);

  /// Returns the number of the poster frame among those seen, from 0.
  [[nodiscard]] int index() const { return index_; }

 private:
  [[nodiscard]] double bend(const Vertices& x) const;

  struct Hinge {
    std::array<int, 2> edge, opposite;
  };
  std::vector<Hinge> hinges_;
  double most_ = -1;
  int seen_ = 0, index_ = 0;
};

}  // namespace drape
