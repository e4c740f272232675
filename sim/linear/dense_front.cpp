#include "sim/linear/dense_front.hpp"

#include <algorithm>
#include <cmath>

namespace drape {
namespace {

using Index = std::size_t;

constexpr int block_size = strip_rows * strip_rows;
// Columns eliminated before the rest of a front is updated, and strips updated together. These rows of these columns
// fit into the second-level cache.
constexpr int columns_at_once = 128;
constexpr int strips_at_once = 32;

int strips_of(int rows) { return (rows + strip_rows - 1) / strip_rows; }

/// Returns the offset of a column in a strip, or of a row in a triangle of eight.
Index eights(int number) { return Index{strip_rows} * static_cast<Index>(number); }

/// Returns the offset of a column of blocks in the update matrix, as if the blocks above the diagonal were stored.
Index left_start(int strips, int column_of_blocks) {
  const auto n = static_cast<Index>(strips), c = static_cast<Index>(column_of_blocks);
  return block_size * (c * (n - 1) - c * (c - 1) / 2);
}

/// Factors the diagonal block into rows of eight numbers, with reciprocals on the diagonal.
/// @returns true if it is positive definite
bool factor_block(const double* block, int width, double* triangle) {
  for (int c = 0; c < width; ++c) {
    const double* row = triangle + eights(c);
    double pivot = block[c * strip_rows + c];
    for (int k = 0; k < c; ++k) pivot -= row[k] * row[k];
    if (!(pivot > 0) || !std::isfinite(pivot)) return false;
    triangle[c * strip_rows + c] = 1 / std::sqrt(pivot);
    for (int r = c + 1; r < width; ++r) {
      double value = block[c * strip_rows + r];
      for (int k = 0; k < c; ++k) value -= triangle[r * strip_rows + k] * row[k];
      triangle[r * strip_rows + c] = value * triangle[c * strip_rows + c];
    }
  }
  return true;
}

/// Writes the inverse of such a triangle, by rows.
double* write_inverse(const double* triangle, int width, double* output) {
  double inverse[block_size];
  for (int r = 0; r < width; ++r) {
    const double* row = triangle + eights(r);
    for (int c = 0; c <= r; ++c) {
      double sum = 0;
      for (int k = c; k < r; ++k) sum += row[k] * inverse[k * strip_rows + c];
      *output++ = inverse[r * strip_rows + c] = c == r ? row[r] : -sum * row[r];
    }
  }
  return output;
}

}  // namespace

std::size_t DenseFront::own_size(int width, int below) {
  return static_cast<Index>(strips_of(width) + strips_of(below)) * block_size * static_cast<Index>(strips_of(width));
}

std::size_t DenseFront::left_size(int below) {
  const auto strips = static_cast<Index>(strips_of(below));
  return block_size * (strips * (strips + 1) / 2);
}

DenseFront::DenseFront(std::size_t largest, int most_below)
    : own_(largest), own_offsets_(static_cast<Index>(most_below)), left_offsets_(static_cast<Index>(most_below)) {}

void DenseFront::begin(int width, int below, double* left) {
  width_ = width;
  below_ = below;
  own_strips_ = strips_of(width);
  strips_ = own_strips_ + strips_of(below);
  stride_ = block_size * static_cast<Index>(own_strips_);
  left_ = left;
  std::fill_n(own_.data(), own_size(width, below), 0.0);
  std::fill_n(left_, left_size(below), 0.0);
}

void DenseFront::add(const std::vector<int>& rows, const double* left) {
  const int count = static_cast<int>(rows.size()), from_strips = strips_of(count);
  const int first_below = strip_rows * own_strips_;
  for (Index t = 0; t < rows.size(); ++t) {
    own_offsets_[t] = offset(rows[t], stride_);
    left_offsets_[t] = rows[t] < first_below ? 0 : offset(rows[t] - first_below, block_size);
  }
  for (int c = 0; c < count; ++c) {
    const int column = rows[static_cast<Index>(c)], column_below = column - first_below;
    const double* from = left + left_start(from_strips, c / strip_rows) + eights(c % strip_rows);
    const bool own = column_below < 0;
    double* to =
        own ? own_.data() + eights(column)
            : left_ + left_start(strips_ - own_strips_, column_below / strip_rows) + eights(column_below % strip_rows);
    const Index* offsets = own ? own_offsets_.data() : left_offsets_.data();
    for (int r = c; r < count; ++r) to[offsets[r]] += from[offset(r, block_size)];
  }
}

bool DenseFront::eliminate(double*& output, Pacer& pacer) {
  double triangle[block_size];
  for (int begin = 0; begin < width_; begin += columns_at_once) {
    const int end = std::min(width_, begin + columns_at_once);
    for (int column = begin; column < end; column += strip_rows) {
      const int first = column / strip_rows, width = std::min(strip_rows, width_ - column);
      subtract(begin, column, first, first, strips_ - first, pacer);
      double* block = strip(first) + eights(column);
      if (!factor_block(block, width, triangle)) return false;
      kernels().divide_strips(triangle, width, block, stride_, strips_ - first);
      output = write_panel(column, width, triangle, output);
    }
    const int later = strips_of(end);
    for (int row = later; row < strips_; row += strips_at_once) {
      const int row_end = std::min(strips_, row + strips_at_once);
      for (int column = later; column < row_end; ++column) {
        const int first = std::max(row, column);
        subtract(begin, end, column, first, row_end - first, pacer);
      }
    }
  }
  return true;
}

/// Subtracts the products of columns begin … end−1 from a strip of columns, for a range of row strips.
void DenseFront::subtract(int begin, int end, int column_strip, int first_strip, int count, Pacer& pacer) {
  if (begin == end) return;
  const Index from = eights(begin);
  const int left_column = column_strip - own_strips_;
  double* left = left_column < 0 ? nullptr
                                 : left_ + left_start(strips_ - own_strips_, left_column) +
                                       block_size * static_cast<Index>(first_strip - own_strips_);
  kernels().subtract_product({.rows = strip(first_strip) + from,
                              .row_stride = stride_,
                              .columns = strip(column_strip) + from,
                              .depth = end - begin,
                              .target = left != nullptr ? left : strip(first_strip) + eights(strip_rows * column_strip),
                              .target_stride = left != nullptr ? Index{block_size} : stride_,
                              .strips = count});
  pacer.did(2.0 * block_size * count * (end - begin));
}

/// Writes a group of neighbouring finished columns.
double* DenseFront::write_panel(int column, int width, const double* triangle, double* output) {
  output = write_inverse(triangle, width, output);
  const auto write_rows = [&](int row, int end) {
    for (; row < end; ++row) {
      const double* from = &own(row, column);
      for (int c = 0; c < width; ++c) *output++ = from[eights(c)];
    }
  };
  write_rows(column + width, width_);
  write_rows(row_below(0), row_below(below_));
  return output;
}

}  // namespace drape
