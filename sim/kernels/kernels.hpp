#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
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

/// Maximum number of springs or vertices per kernel call; its scratch memory fits into the first-level cache.
inline constexpr int kernel_size = 256;

/// Maximum number of bands per stretch.
inline constexpr int max_bands = 8;

/// Springs (v, v + offset) of consecutive vertices v, one each; missing springs have zero stiffness. Pointers refer to
/// the spring of a stretch's first vertex.
struct SpringBand {
  int offset;
  const double* stiffness;    ///< [N/m]
  const double* rest_length;  ///< [m]
  Columns<double> force;      ///< scratch; preceded by the forces of the `offset` springs before the stretch [N]
};

/// Consecutive vertices and the bands of springs that start at them.
struct SpringStretch {
  int count;           ///< number of vertices, at most kernel_size
  int vertices_after;  ///< number of the cloth's vertices after them
  const SpringBand* bands;
  int band_count;  ///< sorted by offset, the largest last
};

/// Move of vertices with decaying velocities: velocity *= before, position += h·velocity, velocity *= after.
struct Drift {
  double h;           ///< [s]
  double before = 1;  ///< 1: no change
  double after = 1;   ///< 1: no change
};

/// Explicit step from the springs' gradient: velocity += factor·(∇E − force), then the move of a `Drift`. For the
/// vertices of a stretch.
struct SpringKick {
  const double* factor;         ///< −h/m, 0 on pins [s/kg]
  Columns<const double> force;  ///< of everything outside of bands [N]
  Drift drift;
  Columns<double> velocity;    ///< [m/s]
  Columns<const double> from;  ///< positions of the vertices and of their springs' other ends [m]
  Columns<double> position;    ///< may equal `from` [m]
};

/// Inertial term that an implicit step's objective adds to the springs' energy: Σ factor/2 (x − y)². For the vertices
/// of a stretch.
struct SpringInertia {
  const double* factor;      ///< m/h² [N/m]
  Columns<const double> y;   ///< [m]
  Columns<double> gradient;  ///< receives the gradient of both terms [N]
};

/// Springs (i[t], j[t]), t < count, in any order.
struct SpringList {
  const int* i;
  const int* j;
  int count;
  const double* stiffness;     ///< [N/m]
  const double* rest_length;   ///< [m]
  Columns<double> force = {};  ///< if not null, receives each spring's force on i instead of adding forces
};

/// Hessian blocks of springs, one entry per spring: K = across·I + along·alongᵀ.
template <class T>
struct SpringBlocksOf {
  T* across;         ///< [N/m]
  Columns<T> along;  ///< [√(N/m)]
};
using SpringBlocks = SpringBlocksOf<double>;
using ConstSpringBlocks = SpringBlocksOf<const double>;

/// Maximum width of a packed triangle's panels, so that the unknowns of its rows stay in registers.
inline constexpr int panel_width = 8;

/// Neighbouring columns of a packed triangle that share the rows below them.
struct Panel {
  int first, width;  ///< columns first … first+width−1
  int row_count;     ///< number of rows below
};

/// Returns the numbers stored for a panel of a packed triangle.
constexpr std::size_t panel_size(const Panel& panel) {
  const auto width = static_cast<std::size_t>(panel.width);
  return width * (width + 1) / 2 + width * static_cast<std::size_t>(panel.row_count);
}

/// A lower-triangular matrix as panels in the order of their columns. The values of a panel are stored in the order of
/// the solver's reads: the inverse of its dense diagonal triangle, by rows, then `width` values for each row below.
template <class T>
struct PackedTriangle {
  const Panel* panels;
  int panel_count;
  const int* rows;                             ///< of all panels, one after another
  const T* values;                             ///< of all panels, one after another
  std::size_t row_total = 0, value_total = 0;  ///< totals, for backward substitution alone
};

/// Rows of a dense matrix per strip. A strip is stored by columns, each contiguous.
inline constexpr int strip_rows = 8;

/// Operands of target −= rows·columnsᵀ for some strips of rows and one of columns. Strides count numbers from one strip
/// to the next.
struct StripProduct {
  const double* rows;  ///< `depth` columns of each strip
  std::size_t row_stride;
  const double* columns;  ///< `depth` columns of one strip, whose rows are the target's columns
  int depth;
  double* target;  ///< eight columns of each strip
  std::size_t target_stride;
  int strips;
};

/// Pairs of features whose vertices move on straight paths.
struct PairPaths {
  const float* rows;    ///< eight numbers a vertex: x, y, z, 0 at the start of its path, then at the end [m]
  const int* vertices;  ///< four vertices of the first pair
  int stride;           ///< numbers from one pair's vertices to the next's
  int count;
  float reach;  ///< [m]
};

/// The hot loops, compiled once per instruction set. All versions give the same bits: the same operations on each
/// element, sums in the same order, no fused multiply-add. Sums over many numbers use eight interleaved lanes.
struct Kernels {
  std::string_view name;  ///< "sse2", "avx2" or "avx512"
  int (*supported)();     ///< returns nonzero if this processor can run them

  /// Adds ∇E of the springs to the gradient, E = Σ k/2 (‖x_i − x_j‖ − L)² [N]. The `value` versions return E [J].
  void (*add_list_gradient)(const SpringList&, Columns<const double> positions, Columns<double> gradient);
  double (*add_list_value_gradient)(const SpringList&, Columns<const double> positions, Columns<double> gradient);
  double (*add_band_value_gradient)(const SpringStretch&, Columns<const double> positions, Columns<double> gradient);
  /// Computes the gradient of inertia and bands; returns the value of both [J].
  double (*evaluate_bands)(const SpringStretch&, Columns<const double> positions, const SpringInertia&);
  /// Moves the vertices of a stretch by an explicit step. Stretches must be passed in order. Returns Σ‖position‖²,
  /// which is not finite if any position is not [m²].
  double (*kick_bands)(const SpringStretch&, const SpringKick&);

  /// Computes the springs' Hessian blocks at some positions, see SpringNetwork and share_across().
  void (*band_blocks)(const SpringBand&, int springs, double concavity, Columns<const double> positions, SpringBlocks);
  void (*list_blocks)(const SpringList&, double concavity, Columns<const double> positions, SpringBlocks);
  /// Adds the springs' Hessian times `vector` to the product; `blocks` has one entry per band.
  void (*add_band_product)(const SpringStretch&, const ConstSpringBlocks* blocks, Columns<const double> vector,
                           Columns<double> product);
  void (*add_list_product)(const SpringList&, ConstSpringBlocks, Columns<const double> vector, Columns<double> product);

  /// Adds factor[t]·from[t] to to[t] for t < count.
  void (*add_scaled)(std::size_t count, const double* factor, const double* from, double* to);
  /// Adds factor·from to `to` for count numbers.
  void (*add_multiple)(std::size_t count, double factor, const double* from, double* to);
  /// Moves `count` coordinates.
  void (*drift)(std::size_t count, const Drift&, double* velocity, double* position);
  /// Computes results[k] = Σ vectors[k][t]·with[t] for k < many, t < count.
  void (*dots)(std::size_t count, int many, const double* const* vectors, const double* with, double* results);
  /// Adds Σ factors[k]·vectors[k] to `to` for k < many, count numbers each.
  void (*add_multiples)(std::size_t count, int many, const double* const* vectors, const double* factors, double* to);

  /// Sets packed[4·row[v] + axis] = from[axis][v] for v < count, and the fourth number of each row to zero.
  void (*pack_single)(int count, Columns<const double> from, const int* row, float* packed);
  void (*pack_double)(int count, Columns<const double> from, const int* row, double* packed);
  /// Sets to[axis][v] = packed[4·row[v] + axis] for v < count.
  void (*unpack_single)(int count, const float* packed, const int* row, Columns<double> to);
  void (*unpack_double)(int count, const double* packed, const int* row, Columns<double> to);
  /// Subtracts packed[4·row[v] + axis] from from[axis][v] for v < count; returns the sum of the squares of these
  /// numbers.
  double (*subtract_packed_single)(int count, const float* packed, const int* row, Columns<double> from);
  double (*subtract_packed_double)(int count, const double* packed, const int* row, Columns<double> from);

  /// Computes x = L⁻ᵀ L⁻¹ x for four right-hand sides, side by side in each row of x (4n numbers).
  void (*solve_single)(const PackedTriangle<float>&, float* x);
  void (*solve_double)(const PackedTriangle<double>&, double* x);
  /// Computes x = L⁻¹ x alone, or x = L⁻ᵀ x.
  void (*forward_single)(const PackedTriangle<float>&, float* x);
  void (*forward_double)(const PackedTriangle<double>&, double* x);
  void (*backward_single)(const PackedTriangle<float>&, float* x);
  void (*backward_double)(const PackedTriangle<double>&, double* x);

  void (*subtract_product)(const StripProduct&);
  /// Computes block := block L⁻ᵀ for `width` columns of some strips, `stride` numbers apart. Rows of L have eight
  /// numbers in `triangle`, with reciprocals on the diagonal.
  void (*divide_strips)(const double* triangle, int width, double* block, std::size_t stride, int strips);

  /// Finds the pairs of edges, or of a vertex and a triangle, that may come within `reach`. Rejects a pair if a slab
  /// wider than `reach` separates its features at both ends of the paths, for one axis, computed in single precision.
  /// Writes the numbers of the other pairs, in ascending order, and returns how many there are.
  int (*near_edges)(const PairPaths&, int* near);
  int (*near_vertices)(const PairPaths&, int* near);
};

/// Returns the fastest kernels for this processor, within the limit of limit_instruction_set().
const Kernels& kernels();

/// Makes kernels() return others from now on, for measurements; they must outlive their use. Do not call while another
/// thread computes.
/// @returns the kernels replaced
const Kernels& replace_kernels(const Kernels& others);

/// Returns every version, slowest first; some may not run here.
std::span<const Kernels* const> all_kernels();

// A spring of stiffness k, rest length L and length ‖d‖ has the Hessian K = k(1 − s)I + k s x̂x̂ᵀ with s = L/‖d‖. It is
// negative across the spring under compression. Curved bending has the same form. A minimisation keeps a fraction of
// the negative part, the concavity: 0 gives a positive semi-definite matrix, 1 the exact Hessian.

/// Upper limit of s; the Hessian of a more compressed spring holds nowhere else.
inline constexpr double most_compressed = 1000;

/// Returns the s for which K has this fraction of its negative part.
inline double share_across(double s, double concavity) {
  const double positive = std::min(s, 1.0);
  return positive + concavity * (std::min(s, most_compressed) - positive);
}

}  // namespace drape
