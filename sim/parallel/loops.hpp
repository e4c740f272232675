#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "sim/parallel/threads.hpp"

namespace drape {

/// Number of vertices from which loops are divided and sums are split into parts; below, division costs more than it
/// gains. The parts of a sum depend on its length alone, so its bits are the same for any number of threads.
inline constexpr int worth_dividing = 8192;
/// The same limit for loops over the vertices' coordinates.
inline constexpr Eigen::Index numbers_worth_dividing = Eigen::Index{3} * worth_dividing;
inline constexpr int most_parts = 64;  ///< in a sum

/// Returns the threads for loops over data of this many vertices: a single one if these are few.
inline const Threads& for_so_many(const Threads& threads, Eigen::Index vertices) {
  return vertices < worth_dividing ? one_thread() : threads;
}

/// Returns the start of part `part` of `parts` in `count` items, at multiples of eight, the size of a cache line.
constexpr Eigen::Index begin_of_part(Eigen::Index count, int part, int parts) {
  return part == parts ? count : count / 8 * part / parts * 8;
}

/// Calls use(first, count) for ranges of indices that together cover all below `count`. Iterations must be independent.
/// @param least number of iterations worth dividing
template <class Use>
void for_ranges(const Threads& threads, Eigen::Index count, Use&& use, Eigen::Index least = worth_dividing) {
  if (threads.count() == 1 || count < least) {
    use(Eigen::Index{0}, count);
    return;
  }
  const int parts = threads.count();
  threads.for_each(parts, [&](int part) {
    const Eigen::Index first = begin_of_part(count, part, parts);
    use(first, begin_of_part(count, part + 1, parts) - first);
  });
}

/// Calls use(i) for all indices below `count`, under the same conditions.
template <class Use>
void for_all(const Threads& threads, Eigen::Index count, Use&& use, Eigen::Index least = worth_dividing) {
  for_ranges(
      threads, count,
      [&](Eigen::Index first, Eigen::Index many) {
        for (Eigen::Index i = first; i < first + many; ++i) use(i);
      },
      least);
}

/// Combines the results of part(first, count) over ranges of indices, in order: as a sum, or by together(so far, next).
/// The ranges depend on `count` alone.
template <class Part, class Together>
auto reduce(const Threads& threads, Eigen::Index count, Part&& part, Together&& together,
            Eigen::Index least = worth_dividing) {
  if (count < least) return part(Eigen::Index{0}, count);
  std::array<decltype(part(count, count)), most_parts> results{};
  // One call covers several parts of the sum, as a part takes less time than a call.
  const int shares = std::min(threads.count(), most_parts);
  threads.for_each(shares, [&](int share) {
    for (int p = most_parts * share / shares; p < most_parts * (share + 1) / shares; ++p) {
      const Eigen::Index first = begin_of_part(count, p, most_parts);
      results[static_cast<std::size_t>(p)] = part(first, begin_of_part(count, p + 1, most_parts) - first);
    }
  });
  auto result = results[0];
  for (std::size_t p = 1; p < results.size(); ++p) result = together(result, results[p]);
  return result;
}

template <class Part>
auto sum_of(const Threads& threads, Eigen::Index count, Part&& part) {
  return reduce(threads, count, part, [](const auto& sum, const auto& next) { return sum + next; });
}

/// Ordered results of a parallel loop, one list per part. The parts depend on the number of items alone. There are more
/// parts than threads, as results are rarely distributed evenly.
template <class Found>
class PartLists {
 public:
  /// Reserves memory for one result per item, to avoid allocations in a step.
  void reserve(Eigen::Index count, Eigen::Index least = worth_dividing) {
    resize(count < least ? 1 : most_parts);
    for (int part = 0; part < parts_; ++part) {
      const Eigen::Index first = begin_of_part(count, part, parts_);
      list(part).reserve(static_cast<std::size_t>(begin_of_part(count, part + 1, parts_) - first));
    }
  }

  /// Replaces the results by those that find(i, list) appends for all indices i below `count`.
  /// @param least number of items worth dividing
  template <class Find>
  void fill(const Threads& threads, Eigen::Index count, Find&& find, Eigen::Index least = worth_dividing) {
    resize(count < least ? 1 : most_parts);
    replace(threads, [&](int part, std::vector<Found>& found) {
      const Eigen::Index end = begin_of_part(count, part + 1, parts_);
      for (Eigen::Index i = begin_of_part(count, part, parts_); i < end; ++i) find(i, found);
    });
  }

  /// Appends the results to others in order.
  void append_to(std::vector<Found>& others) const {
    for (const std::vector<Found>& list : lists()) others.insert(others.end(), list.begin(), list.end());
  }

 private:
  /// Returns one list per part.
  [[nodiscard]] std::span<const std::vector<Found>> lists() const {
    return {lists_.data(), static_cast<std::size_t>(parts_)};
  }
  template <class Find>
  void replace(const Threads& threads, Find&& find) {
    threads.for_each(parts_, [&](int part) {
      // Use a local list: the lists' end pointers share cache lines, to which several threads would write.
      std::vector<Found> found = std::move(list(part));
      found.clear();
      find(part, found);
      list(part) = std::move(found);
    });
  }
  void resize(int parts) {
    parts_ = parts;
    if (lists_.size() < static_cast<std::size_t>(parts)) lists_.resize(static_cast<std::size_t>(parts));
  }
  std::vector<Found>& list(int part) { return lists_[static_cast<std::size_t>(part)]; }

  std::vector<std::vector<Found>> lists_;
  int parts_ = 0;  // of the last loop
};

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

  /// Lists the triangles at every vertex.
  Incidence(const std::vector<std::array<int, 3>>& triangles, int vertex_count)
      : Incidence(corners_of(triangles), 3, vertex_count) {}

  [[nodiscard]] std::span<const int> of(Eigen::Index vertex) const {
    const auto v = static_cast<std::size_t>(vertex);
    return {things_.data() + begin_[v], begin_[v + 1] - begin_[v]};
  }

 private:
  static std::vector<int> corners_of(const std::vector<std::array<int, 3>>& triangles) {
    std::vector<int> corners;
    corners.reserve(3 * triangles.size());
    for (const std::array<int, 3>& t : triangles) corners.insert(corners.end(), t.begin(), t.end());
    return corners;
  }

  std::vector<std::size_t> begin_;  // start of each vertex's items, then the end of the last
  std::vector<int> things_;
};

}  // namespace drape
