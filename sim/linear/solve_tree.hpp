#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
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

/// Invokes the pause callback every few milliseconds of counted work.
class Pacer {
 public:
  /// @param pause may be empty
  explicit Pacer(const std::function<void()>& pause) : pause_(pause) {}
  void did(double operations) {
    since_ += operations;
    if (since_ < operations_at_once) return;
    since_ = 0;
    if (pause_) pause_();
  }

 private:
  static constexpr double operations_at_once = 2e7;
  const std::function<void()>& pause_;
  double since_ = 0;
};

/// The dense lower triangle of a group of columns to eliminate and the rows below. It is stored in strips of eight
/// rows: the rows of its own columns, then, from a new strip on, those below. The rest, the update matrix, is a
/// triangle of 8×8 blocks, by columns of blocks.
class DenseFront {
 public:
  /// Returns the number of values in the strips of a front.
  static std::size_t own_size(int width, int below);
  /// Returns the number of values in the update matrix.
  static std::size_t left_size(int below);

  /// @param largest largest own_size() of all fronts to come
  /// @param most_below largest number of rows below
  DenseFront(std::size_t largest, int most_below);

  /// Begins a front of zeros.
  /// @param left receives the update matrix, left_size(below) numbers
  void begin(int width, int below, double* left);
  /// Returns the row in strips of the t-th row below.
  [[nodiscard]] int row_below(int t) const { return strip_rows * own_strips_ + t; }
  /// Returns an entry of its own columns, by the row in strips.
  double& own(int row, int column) {
    return own_[offset(row, stride_) + strip_rows * static_cast<std::size_t>(column)];
  }
  /// Adds the update matrix of another front.
  /// @param rows its rows in strips of this front, ascending
  /// @param left see begin()
  void add(const std::vector<int>& rows, const double* left);

  /// Eliminates its columns.
  /// @param output receives them as panels, see PackedTriangle; is advanced to their end
  /// @return false if the matrix is not positive definite
  [[nodiscard]] bool eliminate(double*& output, Pacer& pacer);

 private:
  /// Returns the offset of a row from the start of its column.
  static std::size_t offset(int row, std::size_t stride) {
    return static_cast<std::size_t>(row / strip_rows) * stride + static_cast<std::size_t>(row % strip_rows);
  }
  double* strip(int number) { return own_.data() + static_cast<std::size_t>(number) * stride_; }
  void subtract(int begin, int end, int column_strip, int first_strip, int count, Pacer& pacer);
  double* write_panel(int column, int width, const double* triangle, double* output);

  int width_ = 0, below_ = 0, own_strips_ = 0, strips_ = 0;
  std::size_t stride_ = 0;  // between strips
  std::vector<double> own_;
  double* left_ = nullptr;
  std::vector<std::size_t> own_offsets_, left_offsets_;  // of rows to be added
};

/// Kernels of a substitution in one number type.
template <class T>
struct Substitution;
template <>
struct Substitution<float> {
  static constexpr auto pack = &Kernels::pack_single;
  static constexpr auto solve = &Kernels::solve_single;
  static constexpr auto forward = &Kernels::forward_single;
  static constexpr auto backward = &Kernels::backward_single;
  static constexpr auto unpack = &Kernels::unpack_single;
  static constexpr auto subtract = &Kernels::subtract_packed_single;
};
template <>
struct Substitution<double> {
  static constexpr auto pack = &Kernels::pack_double;
  static constexpr auto solve = &Kernels::solve_double;
  static constexpr auto forward = &Kernels::forward_double;
  static constexpr auto backward = &Kernels::backward_double;
  static constexpr auto unpack = &Kernels::unpack_double;
  static constexpr auto subtract = &Kernels::subtract_packed_double;
};

}  // namespace drape
