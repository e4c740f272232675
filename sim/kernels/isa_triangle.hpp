#pragma once

// Substitution with a packed triangle. Included by kernels_isa.cpp only, see there.

#include <cstddef>

#include "sim/kernels/isa_simd.hpp"
#include "sim/kernels/kernels.hpp"

namespace drape {
namespace {

// A row's four numbers in one vector, whatever the instruction set.
using FourSingles = float __attribute__((vector_size(16)));
using FourDoubles = double __attribute__((vector_size(32)));

/// Numbers stored for a panel: panel_size, which is not used here because it would be a header's inline function.
std::ptrdiff_t stored(const Panel& panel) {
  return panel.width * (panel.width + 1) / 2 + std::ptrdiff_t{panel.width} * panel.row_count;
}

/// x := L⁻¹x for the columns of one panel: multiplies by its inverted triangle and takes what follows from the rows
/// below.
template <class Row, int width, class T>
inline void forward(const Panel& panel, const int* rows, const T* values, T* x) {
  T* own = x + 4 * panel.first;
  Row given[width], solved[width];
  for (int r = 0; r < width; ++r) given[r] = load<Row>(own + 4 * r);
  for (int r = 0; r < width; ++r) {
    solved[r] = *values++ * given[0];
    for (int c = 1; c <= r; ++c) solved[r] += *values++ * given[c];
    store<Row>(own + 4 * r, solved[r]);
  }
  for (int p = 0; p < panel.row_count; ++p, values += width) {
    // Two sums, so that an addition waits for fewer others.
    Row even = values[0] * solved[0], odd = {};
    for (int c = 1; c < width; c += 2) odd += values[c] * solved[c];
    for (int c = 2; c < width; c += 2) even += values[c] * solved[c];
    T* target = x + 4 * rows[p];
    store<Row>(target, load<Row>(target) - (even + odd));
  }
}

/// x := L⁻ᵀx for the columns of one panel.
template <class Row, int width, class T>
inline void backward(const Panel& panel, const int* rows, const T* values, T* x) {
  // Narrow panels sum in several chains for the same reason.
  constexpr int chains = width >= 4 ? 1 : width == 1 ? 4 : 2;
  const T* below = values + width * (width + 1) / 2;
  Row sums[chains][width] = {};
  int p = 0;
  for (; p + chains <= panel.row_count; p += chains) {
    for (int chain = 0; chain < chains; ++chain, below += width) {
      const Row value = load<Row>(x + 4 * rows[p + chain]);
      for (int c = 0; c < width; ++c) sums[chain][c] += below[c] * value;
    }
  }
  for (int chain = 0; p < panel.row_count; ++p, ++chain, below += width) {
    const Row value = load<Row>(x + 4 * rows[p]);
    for (int c = 0; c < width; ++c) sums[chain][c] += below[c] * value;
  }
  T* own = x + 4 * panel.first;
  Row rest[width];
  for (int c = 0; c < width; ++c) {
    Row sum = sums[0][c];
    for (int chain = 1; chain < chains; ++chain) sum += sums[chain][c];
    rest[c] = load<Row>(own + 4 * c) - sum;
  }
  for (int c = 0; c < width; ++c) {
    Row solved = values[c * (c + 1) / 2 + c] * rest[c];
    for (int r = c + 1; r < width; ++r) solved += values[r * (r + 1) / 2 + c] * rest[r];
    store<Row>(own + 4 * c, solved);
  }
}

template <class Row, class T>
void solve_packed(const PackedTriangle<T>& triangle, T* x) {
  static_assert(panel_width == 8);
  using Substitution = void (*)(const Panel&, const int*, const T*, T*);
  static constexpr Substitution forwards[] = {forward<Row, 1, T>, forward<Row, 2, T>, forward<Row, 3, T>,
                                              forward<Row, 4, T>, forward<Row, 5, T>, forward<Row, 6, T>,
                                              forward<Row, 7, T>, forward<Row, 8, T>};
  static constexpr Substitution backwards[] = {backward<Row, 1, T>, backward<Row, 2, T>, backward<Row, 3, T>,
                                               backward<Row, 4, T>, backward<Row, 5, T>, backward<Row, 6, T>,
                                               backward<Row, 7, T>, backward<Row, 8, T>};
  const int* rows = triangle.rows;
  const T* values = triangle.values;
  for (int p = 0; p < triangle.panel_count; ++p) {
    const Panel& panel = triangle.panels[p];
    forwards[panel.width - 1](panel, rows, values, x);
    rows += panel.row_count;
    values += stored(panel);
  }
  for (int p = triangle.panel_count - 1; p >= 0; --p) {
    const Panel& panel = triangle.panels[p];
    rows -= panel.row_count;
    values -= stored(panel);
    backwards[panel.width - 1](panel, rows, values, x);
  }
}

}  // namespace
}  // namespace drape
