#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "sim/kernels/vertices.hpp"
#include "sim/parallel/threads.hpp"

namespace drape {

/// From how many vertices on a loop over them is divided, and sums are taken part by part: below, dividing would cost
/// more than it gains. A sum's parts depend on its length alone, so that its bits are the same for any number of
/// threads.
inline constexpr int worth_dividing = 8192;
inline constexpr Eigen::Index numbers_worth_dividing =
    Eigen::Index{3} * worth_dividing;  ///< of loops over the vertices' coordinates
inline constexpr int most_parts = 64;  ///< of a sum

/// The threads for loops over what belongs to so many vertices: where these are few, one.
inline const Threads& for_so_many(const Threads& threads, Eigen::Index vertices) {
  return vertices < worth_dividing ? one_thread() : threads;
}

/// Where part `part` of `parts` begins, of `count` things: at multiples of eight, where cache lines of numbers begin.
constexpr Eigen::Index begin_of_part(Eigen::Index count, int part, int parts) {
  return part == parts ? count : count / 8 * part / parts * 8;
}

/// Calls use(first, count) for ranges of indices which together are all below `count`. For loops whose iterations do
/// not depend on each other.
/// @param least how many of them are worth dividing
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

/// Calls use(i) for all indices below `count`, likewise.
template <class Use>
void for_all(const Threads& threads, Eigen::Index count, Use&& use, Eigen::Index least = worth_dividing) {
  for_ranges(
      threads, count,
      [&](Eigen::Index first, Eigen::Index many) {
        for (Eigen::Index i = first; i < first + many; ++i) use(i);
      },
      least);
}

/// The results of part(first, count) for ranges of indices that depend on `count` alone, put together in their order:
/// a sum, or whatever together(so far, next) makes of two.
template <class Part, class Together>
auto reduce(const Threads& threads, Eigen::Index count, Part&& part, Together&& together,
            Eigen::Index least = worth_dividing) {
  if (count < least) return part(Eigen::Index{0}, count);
  std::array<decltype(part(count, count)), most_parts> results{};
  // A call for several parts of the sum, as one takes less time than handing it out.
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
