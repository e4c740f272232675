#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "sim/parallel/loops.hpp"

namespace drape {

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

  /// Replaces the results by those that find(others, list) appends for each list of other results.
  template <class Other, class Find>
  void fill_from(const Threads& threads, const PartLists<Other>& others, Find&& find) {
    resize(static_cast<int>(others.lists().size()));
    replace(threads,
            [&](int part, std::vector<Found>& found) { find(others.lists()[static_cast<std::size_t>(part)], found); });
  }

  /// Clears the results and keeps the memory.
  void clear() {
    for (std::vector<Found>& list : used()) list.clear();
  }

  [[nodiscard]] Eigen::Index size() const {
    Eigen::Index sum = 0;
    for (const std::vector<Found>& list : lists()) sum += std::ssize(list);
    return sum;
  }

  /// Calls use(found) for all results in order.
  template <class Use>
  void for_each(Use&& use) {
    for (std::vector<Found>& list : used()) {
      for (Found& found : list) use(found);
    }
  }

  /// Calls use(found) for all results, which must be independent.
  template <class Use>
  void for_each(const Threads& threads, Use&& use) const {
    const int shares = size() < worth_dividing ? 1 : threads.count();
    threads.for_each(shares, [&](int share) {
      for (int part = parts_ * share / shares; part < parts_ * (share + 1) / shares; ++part) {
        for (const Found& found : lists()[static_cast<std::size_t>(part)]) use(found);
      }
    });
  }

  /// Appends the results to others in order.
  void append_to(std::vector<Found>& others) const {
    for (const std::vector<Found>& list : lists()) others.insert(others.end(), list.begin(), list.end());
  }

  /// Returns one list per part.
  [[nodiscard]] std::span<const std::vector<Found>> lists() const {
    return {lists_.data(), static_cast<std::size_t>(parts_)};
  }

 private:
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
  std::span<std::vector<Found>> used() { return {lists_.data(), static_cast<std::size_t>(parts_)}; }

  std::vector<std::vector<Found>> lists_;
  int parts_ = 0;  // of the last loop
};

}  // namespace drape
