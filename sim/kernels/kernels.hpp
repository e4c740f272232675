#pragma once

#include <cstddef>
#include <span>
#include <string_view>

namespace drape {

/// The three coordinates of n vertices, each contiguous: the columns of a `Vertices`.
template <class T>
struct Columns {
  T* x;
  T* y;
  T* z;
};

/// How many springs a kernel is given at most: its scratch arrays live on the stack and stay in the first-level cache.
inline constexpr int kernel_springs = 256;

/// Springs (i+t, j+t), t < count, each with its stiffness and rest length. Consecutive springs touch
/// consecutive vertices, so everything is read and written in order.
struct SpringRun {
  int i, j, count;
  const double* stiffness;    ///< [N/m]
  const double* rest_length;  ///< [m]
};

/// Springs (i[t], j[t]), t < count, in any order.
struct SpringList {
  const int* i;
  const int* j;
  int count;
  const double* stiffness;    ///< [N/m]
  const double* rest_length;  ///< [m]
};

/// A lower-triangular matrix by columns, its diagonal apart and inverted.
template <class T>
struct PackedTriangle {
  int size;           ///< n
  const int* starts;  ///< n+1, of each column in rows and values
  const int* rows;    ///< below the diagonal
  const T* values;
  const T* inverse_diagonal;  ///< n
};

/// The hot loops, compiled once for each instruction set. Every version gives the same bits: the same operations on
/// each element, sums in the same order, no fused multiply-add.
struct Kernels {
  std::string_view name;  ///< "sse2", "avx2" or "avx512"
  int (*supported)();     ///< whether this processor can run them

  /// gradient += ∇E of the springs, E = Σ k/2 (‖x_i − x_j‖ − L)².  [N]
  void (*add_run_gradient)(const SpringRun&, Columns<const double> positions, Columns<double> gradient);
  void (*add_list_gradient)(const SpringList&, Columns<const double> positions, Columns<double> gradient);

  /// E of the springs [J], summed in eight interleaved lanes.
  double (*run_energy)(const SpringRun&, Columns<const double> positions);
  double (*list_energy)(const SpringList&, Columns<const double> positions);

  /// velocity += factor[t]·force[t] for t < count.
  void (*accelerate)(std::size_t count, const double* factor, const double* force, double* velocity);
  /// difference = factor[t]·(a[t] − b[t]) for t < count.
  void (*scaled_difference)(std::size_t count, const double* factor, const double* a, const double* b,
                            double* difference);
  /// position += h·velocity for count numbers.
  void (*drift)(std::size_t count, double h, const double* velocity, double* position);

  /// x = L⁻ᵀ L⁻¹ x for four right-hand sides, side by side in each row of x (4n numbers).
  void (*solve_single)(const PackedTriangle<float>&, float* x);
  void (*solve_double)(const PackedTriangle<double>&, double* x);
};

/// The fastest kernels this processor runs, at most those that the environment variable DRAPE_ISA names.
/// @throws UsageError if DRAPE_ISA names none of them
const Kernels& kernels();

/// Every version, slowest first; some may not run here.
std::span<const Kernels* const> all_kernels();

}  // namespace drape
