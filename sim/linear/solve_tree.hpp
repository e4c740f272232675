#pragma once

#include <atomic>
#include <cstddef>
#include <memory>
#include <vector>

#include "sim/kernels/kernels.hpp"
#include "sim/parallel/threads.hpp"

namespace drape {

/// The panels of a packed triangle as a tree of parts, whose branches several threads can solve at once. Of the
/// elimination tree of the panels (Liu 1990), whose leaves are eliminated first, a subtree of little work is a part,
/// and so is what is above them between one fork and the next. In a part's own memory are its rows and, after them, its
/// border: the rows of other parts that it has to do with. Solving forwards, what it takes from those is left in its
/// border, from where its parent fetches it, child by child; solving backwards, it fetches what they have come to from
/// its parent.
///
/// The parts depend on the triangle alone, and so do the bits of a solution, for any number of threads. A small
/// triangle is one part, and is solved as if there were no tree.
class SolveTree {
 public:
  SolveTree() = default;
  /// @param panels, rows of the triangle, see PackedTriangle; its rows are renumbered to their places in memory
  /// @param row_count of the triangle
  SolveTree(std::vector<Panel>& panels, std::vector<int>& rows, int row_count);

  /// The place in memory of a row of the triangle, and how many places there are.
  [[nodiscard]] int place(int row) const { return places_[static_cast<std::size_t>(row)]; }
  [[nodiscard]] int place_count() const { return place_count_; }
  /// How many parts there are.
  [[nodiscard]] int size() const { return static_cast<int>(parts_.size()); }

  /// x = L⁻ᵀ L⁻¹ x for four right-hand sides, side by side at the place of each row (4·place_count numbers). One solve
  /// at a time.
  template <class T>
  void solve(const Threads& threads, const PackedTriangle<T>& triangle, T* x) const;

 private:
  /// Panels that follow each other.
  struct Run {
    int first = 0, count = 0;
    std::size_t row = 0, row_total = 0;      // of PackedTriangle::rows
    std::size_t value = 0, value_total = 0;  // of PackedTriangle::values
  };
  struct Part {
    int parent = -1;  // number of its parent, which is higher
    int top = 0;      // its last panel, whose rows are its border
    int height = 0;   // above the leaves
    double work = 0;  // numbers of its panels
    int place = 0, own = 0, border = 0;
    std::size_t target = 0;  // in targets_: where its border is in its parent's memory
    std::vector<Run> runs = {};
    std::vector<int> children = {};
  };
  /// What is known of the panels while they are divided.
  struct Plan;

  void make_parts(const Plan& plan, std::vector<int>& part_of);
  void sort_parts(std::vector<int>& part_of);
  void fill_parts(const Plan& plan, const std::vector<Panel>& panels, const std::vector<int>& part_of);
  void renumber(const Plan& plan, std::vector<Panel>& panels, std::vector<int>& rows);
  template <class T>
  void forward(const Part& part, const PackedTriangle<T>& triangle, T* x) const;
  template <class T>
  void backward(const Part& part, const PackedTriangle<T>& triangle, T* x) const;

  std::vector<Part> parts_;  // children before their parents
  std::vector<int> places_;
  std::vector<int> targets_;
  int place_count_ = 0;
  mutable unsigned solves_ = 0;  // how many there have been, and for each part the last that it is done with
  std::unique_ptr<std::atomic<unsigned>[]> forward_done_, backward_done_;
};

}  // namespace drape
