#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

namespace drape {

/// Lists of the items (such as springs or triangles) at each vertex, in their order. Threads first compute each item's
/// contributions; these are then summed vertex by vertex in the order of a single thread.
class Incidence {
 public:
  Incidence() = default;
  /// @param vertices of all items, one item after another
  /// @param each     number of vertices per item
  Incidence(std::span<const int> vertices, int each, int vertex_count)
      : begin_(static_cast<std::size_t>(vertex_count) + 1), things_(vertices.size()) {
    for (const int vertex : vertices) ++begin_[static_cast<std::size_t>(vertex) + 1];
    for (std::size_t v = 1; v < begin_.size(); ++v) begin_[v] += begin_[v - 1];
    std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
    for (std::size_t k = 0; k < vertices.size(); ++k) {
      things_[next[static_cast<std::size_t>(vertices[k])]++] = static_cast<int>(k) / each;
    }
  }

  [[nodiscard]] std::span<const int> of(Eigen::Index vertex) const {
    const auto v = static_cast<std::size_t>(vertex);
    return {things_.data() + begin_[v], begin_[v + 1] - begin_[v]};
  }

 private:
  std::vector<std::size_t> begin_;  // start of each vertex's items, then the end of the last
  std::vector<int> things_;
};

}  // namespace drape
