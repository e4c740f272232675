#pragma once

#include <array>
#include <span>
#include <vector>

#include "sim/collision/intersection.hpp"

namespace drape {

/// Finds what of meshes is on the wrong side of a triangle, and where it has to go back.
///
/// Edges that pass through triangles are cut, which may take each piece of a mesh apart. The largest part of a piece is
/// where it belongs, and all others are astray (after Baraff, Witkin and Kass 2003, "Untangling cloth", which decides
/// so between the regions within a curve of intersection). A piece that is not taken apart, as a sheet that a flap goes
/// through, is not astray.
class Entanglement {
 public:
  /// A vertex astray at the end of an edge that passes through a triangle.
  struct Passed {
    int vertex;
    Triangle triangle;
    Point weights;  ///< of its corners, where the edge passes
    Point normal;   ///< of the triangle, unit, towards the edge's other end
  };

  /// @param meshes triangles of each mesh, which number the same points; one mesh is looked at with itself, two with
  ///               each other
  /// @param pins   that are never astray while the rest of their piece is not pinned, ascending
  Entanglement(std::vector<std::vector<Triangle>> meshes, std::size_t point_count, const std::vector<int>& pins);

  /// Looks at the meshes in one place.
  void find(const std::vector<Point>& points);

  /// An edge that passes through a triangle.
  struct Crossing {
    Edge edge;
    Triangle triangle;
  };

  /// Those of each edge one after another.
  [[nodiscard]] std::span<const Crossing> crossings() const { return crossings_; }
  [[nodiscard]] std::span<const Passed> passed() const { return passed_; }
  [[nodiscard]] bool is_astray(int vertex) const { return astray_[static_cast<std::size_t>(vertex)] != 0; }
  template <class Vertices>
  [[nodiscard]] bool any_astray(const Vertices& vertices) const {
    if (passed_.empty()) return false;
    for (const int vertex : vertices) {
      if (is_astray(vertex)) return true;
    }
    return false;
  }

 private:
  void find_parts();
  void add(const Crossing& crossing, const std::vector<Point>& points);
  [[nodiscard]] int root(int vertex) const;

  std::vector<std::vector<Triangle>> meshes_;
  std::vector<std::vector<Edge>> edges_;  // of each mesh
  std::vector<int> piece_;                // a vertex of the same piece, of each vertex
  std::vector<long> weights_;             // of vertices: 1, and of pins more than all others
  std::vector<int> parent_;               // of a forest whose trees are the parts
  std::vector<char> astray_;
  std::vector<Crossing> crossings_;
  std::vector<Passed> passed_;
};

}  // namespace drape
