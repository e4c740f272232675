#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "sim/parallel/loops.hpp"

namespace drape {

/// What a loop finds of the things that it goes over, in their order, whoever computes it: a list for each part of the
/// loop. The parts depend on how many things there are alone, and there are more of them than threads, as what is found
/// is rarely spread evenly.
template <class Found>
class PartLists {
 public:
  /// Takes memory for one of each of `count` things, so that no step has to.
  void reserve(Eigen::Index count, Eigen::Index least = worth_dividing) {
    resize(count, least);
    for (int part = 0; part < parts_; ++part) {
      list(part).reserve(
          static_cast<std::size_t>(begin_of_part(count, part + 1, parts_) - begin_of_part(count, part, parts_)));
    }
  }

  /// Replaces them by what find(first, count, list) appends to a list for ranges of indices which together are all
  /// below `count`.
  /// @param least how many things are worth dividing
  template <class Find>
  void fill(const Threads& threads, Eigen::Index count, Find&& find, Eigen::Index least = worth_dividing) {
    resize(count, least);
    threads.for_each(parts_, [&](int part) {
      // By itself: the lists' ends lie side by side, where threads that push would write to one cache line.
      std::vector<Found> found = std::move(list(part));
      found.clear();
      const Eigen::Index first = begin_of_part(count, part, parts_);
      find(first, begin_of_part(count, part + 1, parts_) - first, found);
      list(part) = std::move(found);
    });
  }

  /// Leaves nothing but memory.
  void clear() {
    for (std::vector<Found>& list : lists()) list.clear();
  }

  /// Calls use(found) for all of them in their order.
  template <class Use>
  void for_each(Use&& use) {
    for (std::vector<Found>& list : lists()) {
      for (Found& found : list) use(found);
    }
  }

  /// Appends them to others in their order.
  void append_to(std::vector<Found>& others) const {
    for (const std::vector<Found>& list : lists()) others.insert(others.end(), list.begin(), list.end());
  }

  [[nodiscard]] std::span<std::vector<Found>> lists() { return {lists_.data(), static_cast<std::size_t>(parts_)}; }
  [[nodiscard]] std::span<const std::vector<Found>> lists() const {
    return {lists_.data(), static_cast<std::size_t>(parts_)};
  }

 private:
  void resize(Eigen::Index count, Eigen::Index least) {
    parts_ = count < least ? 1 : most_parts;
    if (lists_.size() < static_cast<std::size_t>(parts_)) lists_.resize(static_cast<std::size_t>(parts_));
  }
  std::vector<Found>& list(int part) { return lists_[static_cast<std::size_t>(part)]; }

  std::vector<std::vector<Found>> lists_;
  int parts_ = 0;  // of the last loop
};

}  // namespace drape
