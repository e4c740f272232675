#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "sim/mesh.hpp"

namespace drape {

/// Whole numbers of vertices: vertices × columns.
using VertexIntegers = Eigen::Matrix<std::int64_t, Eigen::Dynamic, Eigen::Dynamic>;

/// Lists for each vertex the adjacent ones of lower numbers.
class LowerNeighbours {
 public:
  LowerNeighbours(const std::vector<Triangle>& triangles, Eigen::Index vertices);

  /// Returns the mean of what the lower neighbours of a vertex have, rounded down; 0 for a vertex without any.
  /// @param values of all vertices, of which those below `vertex` are read
  [[nodiscard]] std::int64_t mean(const VertexIntegers& values, Eigen::Index column, Eigen::Index vertex) const;

 private:
  std::vector<std::size_t> begin_;  // by vertex, and one more
  std::vector<int> neighbours_;
};

/// Encodes whole numbers of a mesh's vertices that change from frame to frame, as bytes that compress well.
///
/// A frame is a byte, its mode, and the residuals of all vertices, column after column, as varints (zigzag, 7 bits a
/// byte, the lowest first). Mode 0 has none: nothing has changed. Modes 1 and 2 predict the frame before, and the line
/// through the two frames before. Modes 3 and 4 do so too, and predict each residual by the mean of its lower
/// neighbours' residuals. Each frame has the mode with the shortest residuals. html/motion_data.js decodes it.
class IntegerTrack {
 public:
  IntegerTrack(const std::vector<Triangle>& triangles, Eigen::Index vertices, Eigen::Index columns);

  /// Appends the next frame's bytes.
  void append(const VertexIntegers& now, std::string& bytes);

 private:
  LowerNeighbours neighbours_;
  VertexIntegers before_, two_before_;
  bool first_ = true;
};

/// Appends a number of any sign as a varint.
void append_varint(std::int64_t number, std::string& bytes);

}  // namespace drape
