#pragma once

// Vectors of DRAPE_LANES doubles. Included by kernels_isa.cpp only, see there.

namespace drape {
namespace {

using Vector = double __attribute__((vector_size(8 * DRAPE_LANES)));
constexpr int lanes = DRAPE_LANES;
constexpr int sum_lanes = 8;  // the width that every version sums in, so that all round alike

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

/// 1/√value in single precision, for a first guess. Division and square root are exactly rounded, and so the same on
/// every processor, which the reciprocal instructions are not.
inline double guess_inverse_root(double value) {
  return static_cast<double>(1.0F / __builtin_sqrtf(static_cast<float>(value)));
}
inline Vector guess_inverse_root(Vector value) {
  using Single = float __attribute__((vector_size(4 * DRAPE_LANES)));
  Single root = __builtin_convertvector(value, Single);
  for (int lane = 0; lane < lanes; ++lane) root[lane] = __builtin_sqrtf(root[lane]);
  return __builtin_convertvector(1.0F / root, Vector);
}

/// 1/√value to within two units in the last place, for values that single precision can hold: one step of third order
/// (Householder's) from a guess that is good to 2⁻²². Costs a quarter of a square root and a division in double.
template <class V>
inline V inverse_root(V value) {
  const V guess = guess_inverse_root(value);
  const V error = 1.0 - value * guess * guess;
  return guess + guess * error * (0.5 + 0.375 * error);
}

/// A sum in eight interleaved lanes: term t goes to lane t mod 8, and the lanes are added up at the end.
struct LaneSum {
  alignas(64) double sums[sum_lanes] = {};
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
