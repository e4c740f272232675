#pragma once

// Conversion between columns x, y and z and rows of four numbers. Only for inclusion by kernels_isa.cpp, see there.

#include "sim/kernels/isa_triangle.hpp"
#include "sim/kernels/kernels.hpp"

namespace drape {
namespace {

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
