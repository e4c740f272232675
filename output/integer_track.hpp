#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "sim/mesh.hpp"

namespace drape {

/// Integers of vertices: vertices × columns.
using VertexIntegers = Eigen::Matrix<std::int64_t, Eigen::Dynamic, Eigen::Dynamic>;

/// Lists of each vertex's neighbours with lower numbers.
class LowerNeighbours {
 public:
  LowerNeighbours(const std::vector<Triangle>& triangles, Eigen::Index vertices);

  /// Returns the mean over a vertex's lower neighbours, rounded down; 0 without such neighbours.
  /// @param values values of all vertices; those below `vertex` are read
  [[nodiscard]] std::int64_t mean(const VertexIntegers& values, Eigen::Index column, Eigen::Index vertex) const;

 private:
  std::vector<std::size_t> begin_;  // per vertex, and one more
  std::vector<int> neighbours_;
};

/// Encodes integers of a mesh's vertices that change from frame to frame, as bytes that compress well.
///
/// A frame is a mode byte, followed by the residuals of all vertices, column after column, as varints (zigzag, 7 bits
/// per byte, the lowest first). Mode 0 has no residuals: nothing has changed. Mode 1 predicts the previous frame, mode
/// 2 the line through the two previous frames. Modes 3 and 4 do the same and predict each residual by the mean of its
/// lower neighbours' residuals. Each frame uses the mode with the shortest residuals. html/motion_data.js decodes it.
class IntegerTrack {
 public:
  IntegerTrack(const std::vector<Triangle>& triangles, Eigen::Index vertices, Eigen::Index columns);

  /// Appends the bytes of the next frame.
  void append(const VertexIntegers& now, std::string& bytes);

 private:
  LowerNeighbours neighbours_;
  VertexIntegers before_, two_before_;
  bool first_ = true;
};

/// Appends a signed number as a varint.
void append_varint(std::int64_t number, std::string& bytes);

}  // namespace drape
