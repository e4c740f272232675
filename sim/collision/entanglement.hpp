#pragma once

#include <array>
#include <span>
#include <vector>

#include "sim/collision/distance.hpp"

namespace drape {

/// Returns the root of a vertex's tree in a forest of parents; a root is its own parent.
[[nodiscard]] int root_of(const std::vector<int>& parent, int vertex);
/// Joins the trees of two vertices under the smaller root.
void join_trees(std::vector<int>& parent, int i, int j);

/// Search for the vertices of meshes on the wrong side of a triangle, and for the way back.
///
/// Edges that pass through triangles are cut, which may divide a piece of a mesh into parts. The largest part of a
/// piece is in its place, all others are astray (after Baraff, Witkin and Kass 2003, "Untangling cloth", who decide
/// this for the regions inside a curve of intersection). A piece that stays whole is not astray, as a sheet pierced by
/// a flap.
class Entanglement {
 public:
  /// A vertex astray at the end of an edge that passes through a triangle.
  struct Passed {
    int vertex;
    Triangle triangle;
    Point weights;  ///< of its corners, where the edge passes
    Point normal;   ///< of the triangle, unit, towards the edge's other end
  };

  /// @param meshes triangles of each mesh, with indices of the same points. One mesh is tested against itself, two
  ///               against each other.
  /// @param pins   pinned vertices, ascending. They are astray only if the rest of their piece is pinned as well.
  Entanglement(std::vector<std::vector<Triangle>> meshes, std::size_t point_count, const std::vector<int>& pins);

  /// Tests the meshes with their points at these positions.
  void find(const std::vector<Point>& points);

  /// An edge that passes through a triangle.
  struct Crossing {
    Edge edge;
    Triangle triangle;
  };

  /// Returns all crossings, sorted by edges.
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
  std::vector<std::vector<Edge>> edges_;  // edges of each mesh
  std::vector<int> piece_;                // representative vertex of the piece of each vertex
  std::vector<long> weights_;             // 1 for a vertex; a pin outweighs all others
  std::vector<int> parent_;               // forest whose trees are the parts
  std::vector<char> astray_;
  std::vector<Crossing> crossings_;
  std::vector<Passed> passed_;
};

}  // namespace drape
