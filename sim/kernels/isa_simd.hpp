#pragma once

// Vectors of DRAPE_LANES doubles, and loops over plain arrays. Only for inclusion by kernels_isa.cpp, see there.

#include <cstddef>

#include "sim/kernels/kernels.hpp"

namespace drape {
namespace {

using Vector = double __attribute__((vector_size(8 * DRAPE_LANES)));
constexpr int lanes = DRAPE_LANES;
constexpr int sum_lanes = 8;  // lanes of a sum in every version, for equal rounding

template <class V>
inline V load(const void* from) {
  V value;
  __builtin_memcpy(&value, from, sizeof value);
  return value;
}

template <class V>
inline void store(void* to, V value) {
  __builtin_memcpy(to, &value, sizeof value);
}

inline double smaller(double a, double b) { return a < b ? a : b; }
inline Vector smaller(Vector a, Vector b) { return a < b ? a : b; }

inline double square_root(double value) { return __builtin_sqrt(value); }
inline Vector square_root(Vector value) {
  for (int lane = 0; lane < lanes; ++lane) value[lane] = __builtin_sqrt(value[lane]);
  return value;
}

/// A sum in eight interleaved lanes: term t goes to lane t mod 8; the lanes are summed at the end.
struct LaneSum {
  alignas(64) double sums[sum_lanes];
  template <class V>
  void add(int t, V terms) {
    double* lane = sums + t % sum_lanes;
    store<V>(lane, load<V>(lane) + terms);
  }
  double total() const {
    double result = 0;
    for (const double sum : sums) result += sum;
    return result;
  }
};

void add_scaled(std::size_t count, const double* __restrict factor, const double* __restrict from,
                double* __restrict to) {
  for (std::size_t t = 0; t < count; ++t) to[t] += factor[t] * from[t];
}

void add_multiple(std::size_t count, double factor, const double* __restrict from, double* __restrict to) {
  for (std::size_t t = 0; t < count; ++t) to[t] += factor * from[t];
}

void drift(std::size_t count, const Drift& drift, double* __restrict velocity, double* __restrict position) {
  const double before = drift.before, h = drift.h, after = drift.after;
  for (std::size_t t = 0; t < count; ++t) {
    const double v = before * velocity[t];
    position[t] += h * v;
    velocity[t] = after * v;
  }
}

/// Partial sums in interleaved lanes, kept in registers.
template <int sum_lanes>
struct Accumulator {
  static constexpr int parts = sum_lanes / lanes;
  Vector sums[parts] = {};

  /// Returns the total after adding term(t) to lane t − first for the remaining terms.
  template <class Term>
  double total_with(std::size_t first, std::size_t end, Term&& term) const {
    alignas(64) double values[sum_lanes];
    for (int part = 0; part < parts; ++part) store<Vector>(values + part * lanes, sums[part]);
    for (std::size_t t = first; t < end; ++t) values[t - first] += term(t);
    double result = 0;
    for (const double value : values) result += value;
    return result;
  }
};

/// Computes the dot products of `many` vectors with one, in a single pass over that one.
template <int many>
inline void dots_of(std::size_t count, const double* const* vectors, const double* with, double* results) {
  // A single sum uses more lanes, so that additions wait less for each other.
  constexpr int width = many == 1 ? 2 * sum_lanes : sum_lanes;
  Accumulator<width> sum[many];
  std::size_t t = 0;
  for (; t + width <= count; t += width) {
    for (std::size_t part = 0; part < Accumulator<width>::parts; ++part) {
      const std::size_t at = t + part * lanes;
      const Vector value = load<Vector>(with + at);
      for (int k = 0; k < many; ++k) sum[k].sums[part] += load<Vector>(vectors[k] + at) * value;
    }
  }
  for (int k = 0; k < many; ++k) {
    results[k] = sum[k].total_with(t, count, [&](std::size_t rest) { return vectors[k][rest] * with[rest]; });
  }
}

void dots(std::size_t count, int many, const double* const* vectors, const double* with, double* results) {
  int k = 0;
  for (; k + 4 <= many; k += 4) dots_of<4>(count, vectors + k, with, results + k);
  for (; k < many; ++k) dots_of<1>(count, vectors + k, with, results + k);
}

template <int many>
inline void add_multiples_of(std::size_t count, const double* const* vectors, const double* factors,
                             double* __restrict to) {
  std::size_t t = 0;
  for (; t + lanes <= count; t += lanes) {
    Vector value = load<Vector>(to + t);
    for (int k = 0; k < many; ++k) value += factors[k] * load<Vector>(vectors[k] + t);
    store<Vector>(to + t, value);
  }
  for (; t < count; ++t) {
    for (int k = 0; k < many; ++k) to[t] += factors[k] * vectors[k][t];
  }
}

void add_multiples(std::size_t count, int many, const double* const* vectors, const double* factors, double* to) {
  int k = 0;
  for (; k + 4 <= many; k += 4) add_multiples_of<4>(count, vectors + k, factors + k, to);
  for (; k < many; ++k) add_multiples_of<1>(count, vectors + k, factors + k, to);
}

}  // namespace
}  // namespace drape
