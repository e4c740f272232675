#pragma once

// Vectors of DRAPE_LANES doubles. Only for inclusion by kernels_isa.cpp, see there.

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

}  // namespace
}  // namespace drape
