#pragma once

// Substitution with a packed triangle, and conversion between columns x, y and z and its rows of four numbers. Only for
// inclusion by kernels_isa.cpp, see there.

#include <cstddef>

#include "sim/kernels/isa_simd.hpp"
#include "sim/kernels/kernels.hpp"

namespace drape {
namespace {

// One row's four numbers in one vector for any instruction set, and two rows in one vector.
using FourSingles = float __attribute__((vector_size(16)));
using FourDoubles = double __attribute__((vector_size(32)));
using EightSingles = float __attribute__((vector_size(32)));
using EightDoubles = double __attribute__((vector_size(64)));

template <class Row>
struct PairOf;
template <>
struct PairOf<FourSingles> {
  using Type = EightSingles;
};
template <>
struct PairOf<FourDoubles> {
  using Type = EightDoubles;
};

/// Joins two rows; low_of() and high_of() split the pair.
template <class Row>
inline typename PairOf<Row>::Type join(Row low, Row high) {
  return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7);
}
template <class Row>
inline Row low_of(typename PairOf<Row>::Type pair) {
  return __builtin_shufflevector(pair, pair, 0, 1, 2, 3);
}
template <class Row>
inline Row high_of(typename PairOf<Row>::Type pair) {
  return __builtin_shufflevector(pair, pair, 4, 5, 6, 7);
}

/// Returns four copies of the first of two numbers and four of the second. In single precision: one read, one
/// permutation.
inline EightSingles spread(const float* two) {
  const auto bits = load<double>(two);
  const auto both = reinterpret_cast<EightSingles>(FourDoubles{bits, bits, bits, bits});
  return __builtin_shufflevector(both, both, 0, 0, 0, 0, 5, 5, 5, 5);
}
inline EightDoubles spread(const double* two) {
  return EightDoubles{two[0], two[0], two[0], two[0], two[1], two[1], two[1], two[1]};
}

/// Returns the numbers stored for a panel. panel_size is a header's inline function and must not be used here.
std::ptrdiff_t stored(const Panel& panel) {
  return panel.width * (panel.width + 1) / 2 + std::ptrdiff_t{panel.width} * panel.row_count;
}

/// Computes x := L⁻¹x for the columns of one panel: multiplies by its inverted triangle and subtracts the contributions
/// from the rows below. Columns are processed in pairs.
template <class Row, int width, class T>
inline void forward(const Panel& panel, const int* rows, const T* values, T* x) {
  using Pair = typename PairOf<Row>::Type;
  constexpr int pairs = width / 2;
  T* own = x + 4 * panel.first;
  Row given[width], solved[width];
  for (int r = 0; r < width; ++r) given[r] = load<Row>(own + 4 * r);
  for (int r = 0; r < width; ++r) {
    solved[r] = *values++ * given[0];
    for (int c = 1; c <= r; ++c) solved[r] += *values++ * given[c];
    store<Row>(own + 4 * r, solved[r]);
  }
  Pair paired[pairs > 0 ? pairs : 1];
  for (int c = 0; c < pairs; ++c) paired[c] = join(solved[2 * c], solved[2 * c + 1]);
  for (int p = 0; p < panel.row_count; ++p, values += width) {
    Pair sum{};
    for (int c = 0; c < pairs; ++c) sum += spread(values + 2 * c) * paired[c];
    Row even = low_of<Row>(sum);
    if constexpr (width % 2 == 1) even += values[width - 1] * solved[width - 1];
    T* target = x + 4 * rows[p];
    store<Row>(target, load<Row>(target) - (even + high_of<Row>(sum)));
  }
}

/// Computes x := L⁻ᵀx for the columns of one panel.
template <class Row, int width, bool from_last, class T>
inline void backward(const Panel& panel, const int* rows, const T* values, T* x) {
  using Pair = typename PairOf<Row>::Type;
  // Narrow panels sum in several chains, so that additions wait less for each other.
  constexpr int chains = width >= 4 ? 1 : width == 1 ? 4 : 2;
  constexpr int pairs = width / 2;
  const T* below = from_last ? values + stored(panel) - width : values + width * (width + 1) / 2;
  const int* row = from_last ? rows + panel.row_count - 1 : rows;
  constexpr int next = from_last ? -1 : 1;
  Pair sums[chains][pairs > 0 ? pairs : 1] = {};
  Row last[chains] = {};
  const auto add = [&](int chain) {
    const Row value = load<Row>(x + 4 * *row);
    const Pair twice = join(value, value);
    for (int c = 0; c < pairs; ++c) sums[chain][c] += spread(below + 2 * c) * twice;
    if constexpr (width % 2 == 1) last[chain] += below[width - 1] * value;
    below += next * width;
    row += next;
  };
  int left = panel.row_count;
  for (; left >= chains; left -= chains) {
    for (int chain = 0; chain < chains; ++chain) add(chain);
  }
  for (int chain = 0; chain < left; ++chain) add(chain);

  T* own = x + 4 * panel.first;
  Row rest[width];
  for (int chain = 1; chain < chains; ++chain) {
    for (int c = 0; c < pairs; ++c) sums[0][c] += sums[chain][c];
    last[0] += last[chain];
  }
  for (int c = 0; c < width; ++c) {
    const Row sum = c == 2 * pairs ? last[0] : c % 2 == 0 ? low_of<Row>(sums[0][c / 2]) : high_of<Row>(sums[0][c / 2]);
    rest[c] = load<Row>(own + 4 * c) - sum;
  }
  for (int c = 0; c < width; ++c) {
    Row solved = values[c * (c + 1) / 2 + c] * rest[c];
    for (int r = c + 1; r < width; ++r) solved += values[r * (r + 1) / 2 + c] * rest[r];
    store<Row>(own + 4 * c, solved);
  }
}

template <class T>
using Substitution = void (*)(const Panel&, const int*, const T*, T*);
template <class Row, class T>
constexpr Substitution<T> forwards[] = {forward<Row, 1, T>, forward<Row, 2, T>, forward<Row, 3, T>, forward<Row, 4, T>,
                                        forward<Row, 5, T>, forward<Row, 6, T>, forward<Row, 7, T>, forward<Row, 8, T>};
template <class Row, bool from_last, class T>
constexpr Substitution<T> backwards[] = {backward<Row, 1, from_last, T>, backward<Row, 2, from_last, T>,
                                         backward<Row, 3, from_last, T>, backward<Row, 4, from_last, T>,
                                         backward<Row, 5, from_last, T>, backward<Row, 6, from_last, T>,
                                         backward<Row, 7, from_last, T>, backward<Row, 8, from_last, T>};
static_assert(panel_width == 8);

/// Computes x := L⁻¹x, panel by panel.
/// @param rows, values of the first panel; advanced to the end of the last
template <class Row, class T>
inline void go_forward(const PackedTriangle<T>& triangle, const int*& rows, const T*& values, T* x) {
  for (int p = 0; p < triangle.panel_count; ++p) {
    const Panel& panel = triangle.panels[p];
    forwards<Row, T>[panel.width - 1](panel, rows, values, x);
    rows += panel.row_count;
    values += stored(panel);
  }
}

/// Computes x := L⁻ᵀx, from the last panel to the first.
/// @param rows, values the end of the last panel's data
template <class Row, bool from_last, class T>
inline void go_back(const PackedTriangle<T>& triangle, const int* rows, const T* values, T* x) {
  for (int p = triangle.panel_count - 1; p >= 0; --p) {
    const Panel& panel = triangle.panels[p];
    rows -= panel.row_count;
    values -= stored(panel);
    backwards<Row, from_last, T>[panel.width - 1](panel, rows, values, x);
  }
}

template <class Row, class T>
void solve_forward(const PackedTriangle<T>& triangle, T* x) {
  const int* rows = triangle.rows;
  const T* values = triangle.values;
  go_forward<Row>(triangle, rows, values, x);
}

// Parts of a large triangle come from memory. They are read backwards, with the last rows of each panel first, so that
// results of the previous panel are needed last. This halves the time. A small triangle fits into the cache and would
// gain little; it keeps the order of its sums and so its bits.
template <class Row, class T>
void solve_backward(const PackedTriangle<T>& triangle, T* x) {
  go_back<Row, true>(triangle, triangle.rows + triangle.row_total, triangle.values + triangle.value_total, x);
}

template <class Row, class T>
void solve_packed(const PackedTriangle<T>& triangle, T* x) {
  const int* rows = triangle.rows;
  const T* values = triangle.values;
  go_forward<Row>(triangle, rows, values, x);
  go_back<Row, false>(triangle, rows, values, x);
}

/// Four vertices, as columns or as rows.
template <class Row>
struct FourVertices {
  Row x, y, z;
};

template <class Row>
inline void store_rows(const FourVertices<Row>& v, const int* row, Row* packed) {
  const Row none{};
  const Row xy01 = __builtin_shufflevector(v.x, v.y, 0, 4, 1, 5), xy23 = __builtin_shufflevector(v.x, v.y, 2, 6, 3, 7);
  const Row z01 = __builtin_shufflevector(v.z, none, 0, 4, 1, 5), z23 = __builtin_shufflevector(v.z, none, 2, 6, 3, 7);
  store<Row>(packed + row[0], __builtin_shufflevector(xy01, z01, 0, 1, 4, 5));
  store<Row>(packed + row[1], __builtin_shufflevector(xy01, z01, 2, 3, 6, 7));
  store<Row>(packed + row[2], __builtin_shufflevector(xy23, z23, 0, 1, 4, 5));
  store<Row>(packed + row[3], __builtin_shufflevector(xy23, z23, 2, 3, 6, 7));
}

template <class Row>
inline FourVertices<Row> load_rows(const Row* packed, const int* row) {
  const Row a = load<Row>(packed + row[0]), b = load<Row>(packed + row[1]);
  const Row c = load<Row>(packed + row[2]), d = load<Row>(packed + row[3]);
  const Row xy01 = __builtin_shufflevector(a, b, 0, 4, 1, 5), xy23 = __builtin_shufflevector(c, d, 0, 4, 1, 5);
  const Row z01 = __builtin_shufflevector(a, b, 2, 6, 3, 7), z23 = __builtin_shufflevector(c, d, 2, 6, 3, 7);
  return {__builtin_shufflevector(xy01, xy23, 0, 1, 4, 5), __builtin_shufflevector(xy01, xy23, 2, 3, 6, 7),
          __builtin_shufflevector(z01, z23, 0, 1, 4, 5)};
}

template <class Row, class T>
void pack(int count, Columns<const double> from, const int* row, T* packed) {
  auto* rows = reinterpret_cast<Row*>(packed);
  const auto take = [](const double* column) { return __builtin_convertvector(load<FourDoubles>(column), Row); };
  int v = 0;
  for (; v + 4 <= count; v += 4) {
    store_rows<Row>({take(from.x + v), take(from.y + v), take(from.z + v)}, row + v, rows);
  }
  for (; v < count; ++v) {
    store<Row>(rows + row[v], Row{static_cast<T>(from.x[v]), static_cast<T>(from.y[v]), static_cast<T>(from.z[v]), 0});
  }
}

template <class Row, class T>
void unpack(int count, const T* packed, const int* row, Columns<double> to) {
  const auto* rows = reinterpret_cast<const Row*>(packed);
  const auto give = [](double* column, Row value) { store(column, __builtin_convertvector(value, FourDoubles)); };
  int v = 0;
  for (; v + 4 <= count; v += 4) {
    const FourVertices<Row> four = load_rows(rows, row + v);
    give(to.x + v, four.x);
    give(to.y + v, four.y);
    give(to.z + v, four.z);
  }
  for (; v < count; ++v) {
    const Row one = load<Row>(rows + row[v]);
    to.x[v] = static_cast<double>(one[0]);
    to.y[v] = static_cast<double>(one[1]);
    to.z[v] = static_cast<double>(one[2]);
  }
}

template <class Row, class T>
double subtract_packed(int count, const T* packed, const int* row, Columns<double> from) {
  const auto* rows = reinterpret_cast<const Row*>(packed);
  FourDoubles squares{};
  const auto take = [&](double* column, Row value) {
    const FourDoubles change = __builtin_convertvector(value, FourDoubles);
    store(column, load<FourDoubles>(column) - change);
    squares += change * change;
  };
  int v = 0;
  for (; v + 4 <= count; v += 4) {
    const FourVertices<Row> four = load_rows(rows, row + v);
    take(from.x + v, four.x);
    take(from.y + v, four.y);
    take(from.z + v, four.z);
  }
  double sum = (squares[0] + squares[1]) + (squares[2] + squares[3]);
  for (; v < count; ++v) {
    const Row one = load<Row>(rows + row[v]);
    double* columns[] = {from.x + v, from.y + v, from.z + v};
    for (int axis = 0; axis < 3; ++axis) {
      const auto change = static_cast<double>(one[axis]);
      *columns[axis] -= change;
      sum += change * change;
    }
  }
  return sum;
}

}  // namespace
}  // namespace drape
