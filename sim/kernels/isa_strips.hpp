#pragma once

// Building blocks of a dense factorisation, on strips of eight rows. Only for inclusion by kernels_isa.cpp, see there.
// Every element of a target changes by one product at a time, in the order of the columns. So neither block sizes nor
// vector widths change any bit.

#include <cstddef>

#include "sim/kernels/isa_simd.hpp"
#include "sim/kernels/kernels.hpp"

namespace drape {
namespace {

constexpr int strip_vectors = strip_rows / lanes;
#if defined(__aarch64__) || DRAPE_LANES == 8
constexpr int vector_registers = 32;
#else
constexpr int vector_registers = 16;
#endif
// Columns processed together: as many as fit into half of the registers, beside the rows or a second strip.
constexpr int strip_columns = vector_registers / 2 / strip_vectors < 8 ? vector_registers / 2 / strip_vectors : 8;

/// Processes `at_once` strips and `strip_columns` of their columns, which stay in registers.
template <int at_once>
inline void subtract_block(const StripProduct& p, const double* rows, const double* columns, double* target) {
  Vector sums[at_once][strip_columns][strip_vectors];
  for (int s = 0; s < at_once; ++s) {
    for (std::ptrdiff_t c = 0; c < strip_columns; ++c) {
      for (std::ptrdiff_t v = 0; v < strip_vectors; ++v) {
        sums[s][c][v] =
            load<Vector>(target + static_cast<std::size_t>(s) * p.target_stride + c * strip_rows + v * lanes);
      }
    }
  }
  for (std::ptrdiff_t k = 0; k < p.depth; ++k) {
    for (int s = 0; s < at_once; ++s) {
      for (std::ptrdiff_t v = 0; v < strip_vectors; ++v) {
        const Vector row = load<Vector>(rows + static_cast<std::size_t>(s) * p.row_stride + k * strip_rows + v * lanes);
        for (std::ptrdiff_t c = 0; c < strip_columns; ++c) sums[s][c][v] -= row * columns[k * strip_rows + c];
      }
    }
  }
  for (int s = 0; s < at_once; ++s) {
    for (std::ptrdiff_t c = 0; c < strip_columns; ++c) {
      for (std::ptrdiff_t v = 0; v < strip_vectors; ++v) {
        store(target + static_cast<std::size_t>(s) * p.target_stride + c * strip_rows + v * lanes, sums[s][c][v]);
      }
    }
  }
}

void subtract_product(const StripProduct& p) {
  constexpr int at_once = lanes == 8 ? 2 : 1;
  int strip = 0;
  const auto at = [&](int number, std::size_t stride) { return static_cast<std::size_t>(number) * stride; };
  for (; strip + at_once <= p.strips; strip += at_once) {
    for (std::ptrdiff_t c = 0; c < strip_rows; c += strip_columns) {
      subtract_block<at_once>(p, p.rows + at(strip, p.row_stride), p.columns + c,
                              p.target + at(strip, p.target_stride) + c * strip_rows);
    }
  }
  for (; strip < p.strips; ++strip) {
    for (std::ptrdiff_t c = 0; c < strip_rows; c += strip_columns) {
      subtract_block<1>(p, p.rows + at(strip, p.row_stride), p.columns + c,
                        p.target + at(strip, p.target_stride) + c * strip_rows);
    }
  }
}

void divide_strips(const double* triangle, int width, double* block, std::size_t stride, int strips) {
  for (int strip = 0; strip < strips; ++strip, block += stride) {
    for (std::ptrdiff_t v = 0; v < strip_rows; v += lanes) {
      for (std::ptrdiff_t c = 0; c < width; ++c) {
        Vector value = load<Vector>(block + c * strip_rows + v);
        for (std::ptrdiff_t d = 0; d < c; ++d)
          value -= load<Vector>(block + d * strip_rows + v) * triangle[c * strip_rows + d];
        store(block + c * strip_rows + v, value * triangle[c * strip_rows + c]);
      }
    }
  }
}

}  // namespace
}  // namespace drape
