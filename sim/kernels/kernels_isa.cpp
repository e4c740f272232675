// Compiled once for each instruction set: DRAPE_KERNELS is the name, DRAPE_LANES the doubles in a vector register.
// Nothing with external linkage but the table may be defined or instantiated in this file, not even an inline function
// of a header: the linker would keep one copy for the whole program, perhaps the one that an older processor cannot
// run.

#include "sim/kernels/kernels.hpp"

namespace drape {

#define DRAPE_JOIN_(a, b) a##b
#define DRAPE_JOIN(a, b) DRAPE_JOIN_(a, b)
#define DRAPE_TABLE DRAPE_JOIN(kernels_, DRAPE_KERNELS)
#define DRAPE_STRING_(a) #a
#define DRAPE_STRING(a) DRAPE_STRING_(a)

extern const Kernels DRAPE_TABLE;

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

inline double square_root(double value) { return __builtin_sqrt(value); }
inline Vector square_root(Vector value) {
  for (int lane = 0; lane < lanes; ++lane) value[lane] = __builtin_sqrt(value[lane]);
  return value;
}

/// What a spring of zero length is taken for: the direction is undefined there, and its force must be zero, not NaN.
constexpr double tiny = 1e-280;

/// The differences x_i − x_j of some springs.
struct Differences {
  alignas(64) double x[kernel_springs];
  alignas(64) double y[kernel_springs];
  alignas(64) double z[kernel_springs];
};

template <class V>
inline V length_at(const Differences& d, int t) {
  const V x = load<V>(d.x + t), y = load<V>(d.y + t), z = load<V>(d.z + t);
  return square_root(x * x + y * y + z * z + tiny);
}

/// ∇E with respect to x_i: k(1 − L/‖d‖)·d, written over d.
template <class V>
inline void spring_gradient(const double* stiffness, const double* rest_length, Differences& d, int t) {
  const V factor = load<V>(stiffness + t) * (1.0 - load<V>(rest_length + t) / length_at<V>(d, t));
  store<V>(d.x + t, factor * load<V>(d.x + t));
  store<V>(d.y + t, factor * load<V>(d.y + t));
  store<V>(d.z + t, factor * load<V>(d.z + t));
}

template <class V>
inline V spring_energy(const double* stiffness, const double* rest_length, const Differences& d, int t) {
  const V stretch = length_at<V>(d, t) - load<V>(rest_length + t);
  return 0.5 * load<V>(stiffness + t) * (stretch * stretch);
}

void gradients(const double* stiffness, const double* rest_length, int count, Differences& d) {
  int t = 0;
  for (; t + lanes <= count; t += lanes) spring_gradient<Vector>(stiffness, rest_length, d, t);
  for (; t < count; ++t) spring_gradient<double>(stiffness, rest_length, d, t);
}

double energies(const double* stiffness, const double* rest_length, int count, const Differences& d) {
  alignas(64) double sums[sum_lanes] = {};
  int t = 0;
  for (; t + sum_lanes <= count; t += sum_lanes) {
    for (int lane = 0; lane < sum_lanes; lane += lanes) {
      store<Vector>(sums + lane,
                    load<Vector>(sums + lane) + spring_energy<Vector>(stiffness, rest_length, d, t + lane));
    }
  }
  for (int lane = 0; t < count; ++t, ++lane) sums[lane] += spring_energy<double>(stiffness, rest_length, d, t);
  double total = 0;
  for (const double sum : sums) total += sum;
  return total;
}

void run_differences(const SpringRun& run, Columns<const double> p, Differences& d) {
  for (int t = 0; t < run.count; ++t) d.x[t] = p.x[run.i + t] - p.x[run.j + t];
  for (int t = 0; t < run.count; ++t) d.y[t] = p.y[run.i + t] - p.y[run.j + t];
  for (int t = 0; t < run.count; ++t) d.z[t] = p.z[run.i + t] - p.z[run.j + t];
}

void list_differences(const SpringList& list, Columns<const double> p, Differences& d) {
  for (int t = 0; t < list.count; ++t) {
    const int i = list.i[t], j = list.j[t];
    d.x[t] = p.x[i] - p.x[j];
    d.y[t] = p.y[i] - p.y[j];
    d.z[t] = p.z[i] - p.z[j];
  }
}

inline void add(const double* __restrict from, double* __restrict to, int count) {
  for (int t = 0; t < count; ++t) to[t] += from[t];
}
inline void subtract(const double* __restrict from, double* __restrict to, int count) {
  for (int t = 0; t < count; ++t) to[t] -= from[t];
}

void add_run_gradient(const SpringRun& run, Columns<const double> positions, Columns<double> gradient) {
  Differences d;
  run_differences(run, positions, d);
  gradients(run.stiffness, run.rest_length, run.count, d);
  add(d.x, gradient.x + run.i, run.count);
  subtract(d.x, gradient.x + run.j, run.count);
  add(d.y, gradient.y + run.i, run.count);
  subtract(d.y, gradient.y + run.j, run.count);
  add(d.z, gradient.z + run.i, run.count);
  subtract(d.z, gradient.z + run.j, run.count);
}

void add_list_gradient(const SpringList& list, Columns<const double> positions, Columns<double> gradient) {
  Differences d;
  list_differences(list, positions, d);
  gradients(list.stiffness, list.rest_length, list.count, d);
  for (int t = 0; t < list.count; ++t) {
    const int i = list.i[t], j = list.j[t];
    gradient.x[i] += d.x[t];
    gradient.y[i] += d.y[t];
    gradient.z[i] += d.z[t];
    gradient.x[j] -= d.x[t];
    gradient.y[j] -= d.y[t];
    gradient.z[j] -= d.z[t];
  }
}

double run_energy(const SpringRun& run, Columns<const double> positions) {
  Differences d;
  run_differences(run, positions, d);
  return energies(run.stiffness, run.rest_length, run.count, d);
}

double list_energy(const SpringList& list, Columns<const double> positions) {
  Differences d;
  list_differences(list, positions, d);
  return energies(list.stiffness, list.rest_length, list.count, d);
}

void accelerate(std::size_t count, const double* __restrict factor, const double* __restrict force,
                double* __restrict velocity) {
  for (std::size_t t = 0; t < count; ++t) velocity[t] += factor[t] * force[t];
}

void scaled_difference(std::size_t count, const double* __restrict factor, const double* __restrict a,
                       const double* __restrict b, double* __restrict difference) {
  for (std::size_t t = 0; t < count; ++t) difference[t] = factor[t] * (a[t] - b[t]);
}

void drift(std::size_t count, double h, const double* __restrict velocity, double* __restrict position) {
  for (std::size_t t = 0; t < count; ++t) position[t] += h * velocity[t];
}

using Floats = float __attribute__((vector_size(16)));
using Doubles = double __attribute__((vector_size(32)));

/// Both substitutions, with a row's four numbers in one vector. The order of the sums is part of the result: four
/// interleaved partial sums in the backward one, whatever the instruction set.
template <class Row, class T>
void solve_packed(const PackedTriangle<T>& triangle, T* x) {
  for (int c = 0; c < triangle.size; ++c) {
    const Row value = load<Row>(x + 4 * c) * triangle.inverse_diagonal[c];
    store<Row>(x + 4 * c, value);
    for (int p = triangle.starts[c]; p < triangle.starts[c + 1]; ++p) {
      T* target = x + 4 * triangle.rows[p];
      store<Row>(target, load<Row>(target) - triangle.values[p] * value);
    }
  }
  for (int c = triangle.size - 1; c >= 0; --c) {
    Row sums[4] = {};
    const int end = triangle.starts[c + 1];
    int p = triangle.starts[c];
    for (; p + 4 <= end; p += 4) {
      for (int lane = 0; lane < 4; ++lane) {
        sums[lane] += triangle.values[p + lane] * load<Row>(x + 4 * triangle.rows[p + lane]);
      }
    }
    for (int lane = 0; p < end; ++p, ++lane) sums[lane] += triangle.values[p] * load<Row>(x + 4 * triangle.rows[p]);
    const Row sum = (sums[0] + sums[1]) + (sums[2] + sums[3]);
    store<Row>(x + 4 * c, (load<Row>(x + 4 * c) - sum) * triangle.inverse_diagonal[c]);
  }
}

int supported() {
#if DRAPE_LANES == 8
  return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl");
#elif DRAPE_LANES == 4
  return __builtin_cpu_supports("avx2");
#else
  return 1;
#endif
}

}  // namespace

constexpr Kernels DRAPE_TABLE = {
    .name = DRAPE_STRING(DRAPE_KERNELS),
    .supported = supported,
    .add_run_gradient = add_run_gradient,
    .add_list_gradient = add_list_gradient,
    .run_energy = run_energy,
    .list_energy = list_energy,
    .accelerate = accelerate,
    .scaled_difference = scaled_difference,
    .drift = drift,
    .solve_single = solve_packed<Floats, float>,
    .solve_double = solve_packed<Doubles, double>,
};

}  // namespace drape
