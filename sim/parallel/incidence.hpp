#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

namespace drape {

/// Which things meet at each vertex, in their order: so that what they add to their vertices can be computed by threads
/// first, and then added up vertex by vertex in the order in which one thread would have added it.
class Incidence {
 public:
  Incidence() = default;
  /// @param vertices of one thing after another, as many of each
  /// @param each     how many that are
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
  std::vector<std::size_t> begin_;  // of each vertex, and where the last one's end
  std::vector<int> things_;
};

}  // namespace drape
