#pragma once

#include <atomic>
#include <cstddef>
#include <memory>
#include <vector>

#include "sim/kernels/kernels.hpp"
#include "sim/parallel/threads.hpp"

namespace drape {

/// The panels of a packed triangle as a tree of parts, whose branches can be solved in parallel. It follows the
/// elimination tree of the panels (Liu 1990), whose leaves are eliminated first. A subtree of little work forms a part,
/// and so do the panels between two forks above. A part's memory holds its rows, followed by its border: the rows of
/// other parts that it uses. Forward substitution leaves its contributions to those in the border; the parent fetches
/// them, child by child. Backward substitution fetches their values from the parent.
///
/// The parts depend on the triangle alone, so a solution has the same bits for any number of threads. A small triangle
/// is a single part and is solved without a tree.
class SolveTree {
 public:
  SolveTree() = default;
  /// @param panels, rows of the triangle, see PackedTriangle; rows are renumbered to places in memory
  /// @param row_count of the triangle
  SolveTree(std::vector<Panel>& panels, std::vector<int>& rows, int row_count);

  /// Returns the place in memory of a row of the triangle.
  [[nodiscard]] int place(int row) const { return places_[static_cast<std::size_t>(row)]; }
  [[nodiscard]] int place_count() const { return place_count_; }
  /// Returns the number of parts.
  [[nodiscard]] int size() const { return static_cast<int>(parts_.size()); }

  /// Computes x = L⁻ᵀ L⁻¹ x for four right-hand sides, side by side at the place of each row (4·place_count numbers).
  /// Only one solve may run at a time.
  template <class T>
  void solve(const Threads& threads, const PackedTriangle<T>& triangle, T* x) const;

 private:
  /// Consecutive panels.
  struct Run {
    int first = 0, count = 0;
    std::size_t row = 0, row_total = 0;      // in PackedTriangle::rows
    std::size_t value = 0, value_total = 0;  // in PackedTriangle::values
  };
  struct Part {
    int parent = -1;  // index of its parent, which is higher
    int top = 0;      // last panel, whose rows form its border
    int height = 0;   // above the leaves
    double work = 0;  // numbers stored for its panels
    int place = 0, own = 0, border = 0;
    std::size_t target = 0;  // in targets_: positions of its border in its parent's memory
    std::vector<Run> runs = {};
    std::vector<int> children = {};
  };
  /// Data about the panels, used to divide them.
  struct Plan;

  void make_parts(const Plan& plan, std::vector<int>& part_of);
  void sort_parts(std::vector<int>& part_of);
  void fill_parts(const Plan& plan, const std::vector<Panel>& panels, const std::vector<int>& part_of);
  void renumber(const Plan& plan, std::vector<Panel>& panels, std::vector<int>& rows);
  template <class T>
  void forward(const Part& part, const PackedTriangle<T>& triangle, T* x) const;
  template <class T>
  void backward(const Part& part, const PackedTriangle<T>& triangle, T* x) const;

  std::vector<Part> parts_;  // children before parents
  std::vector<int> places_;
  std::vector<int> targets_;
  int place_count_ = 0;
  mutable unsigned solves_ = 0;  // number of solves so far; below, the last one completed by each part
  std::unique_ptr<std::atomic<unsigned>[]> forward_done_, backward_done_;
};

}  // namespace drape
