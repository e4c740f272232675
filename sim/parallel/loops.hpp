#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "sim/kernels/vertices.hpp"
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

}  // namespace drape
