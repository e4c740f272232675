#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "sim/kernels/kernels.hpp"

namespace drape {

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

}  // namespace drape
