#pragma once

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

/// How many springs or vertices a kernel is given at most: its scratch stays in the first-level cache.
inline constexpr int kernel_size = 256;

/// How many bands a stretch can have.
inline constexpr int max_bands = 8;

/// Springs (v, v + offset) of consecutive vertices v, one each: zero stiffness where the cloth has none. The pointers
/// are to the spring of a stretch's first vertex.
struct SpringBand {
  int offset;
  const double* stiffness;    ///< [N/m]
  const double* rest_length;  ///< [m]
  Columns<double> force;      ///< scratch; the forces of the `offset` springs before the stretch lie before it [N]
};

/// Consecutive vertices and the bands of springs that begin at them.
struct SpringStretch {
  int count;           ///< vertices, at most kernel_size
  int vertices_after;  ///< how many vertices the cloth has after them
  const SpringBand* bands;
  int band_count;  ///< by offset, the largest last
};

/// What an explicit step does with the springs' gradient: velocity += factor·(∇E − force), then
/// position = from + h·velocity. For the vertices of a stretch.
struct SpringKick {
  const double* factor;         ///< −h/m, 0 on pins [s/kg]
  Columns<const double> force;  ///< of everything that is not in a band [N]
  double h;                     ///< [s]
  Columns<double> velocity;     ///< [m/s]
  Columns<const double> from;   ///< where the vertices are, and those at their springs' other ends [m]
  Columns<double> position;     ///< may be `from` [m]
};

/// What an implicit step's objective adds to the springs' energy: Σ factor/2 (x − y)². For the vertices of a stretch.
struct SpringInertia {
  const double* factor;      ///< m/h² [N/m]
  Columns<const double> y;   ///< [m]
  Columns<double> gradient;  ///< receives the gradient of both [N]
};

/// Springs (i[t], j[t]), t < count, in any order.
struct SpringList {
  const int* i;
  const int* j;
  int count;
  const double* stiffness;     ///< [N/m]
  const double* rest_length;   ///< [m]
  Columns<double> force = {};  ///< if not null, receives what would be added at each spring's i, and nothing is added
};

/// The springs' Hessian blocks, one entry per spring: K = across·I + along·alongᵀ.
template <class T>
struct SpringBlocksOf {
  T* across;         ///< [N/m]
  Columns<T> along;  ///< [√(N/m)]
};
using SpringBlocks = SpringBlocksOf<double>;
using ConstSpringBlocks = SpringBlocksOf<const double>;

/// The widest panel of a packed triangle: its rows' unknowns stay in registers.
inline constexpr int panel_width = 8;

/// Neighbouring columns of a packed triangle that share the rows below them.
struct Panel {
  int first, width;  ///< columns first … first+width−1
  int row_count;     ///< rows below the last of them
};

/// Numbers that a packed triangle stores for a panel.
constexpr std::size_t panel_size(const Panel& panel) {
  const auto width = static_cast<std::size_t>(panel.width);
  return width * (width + 1) / 2 + width * static_cast<std::size_t>(panel.row_count);
}

/// A lower-triangular matrix as panels in the order of their columns. The values of a panel follow each other as the
/// solver reads them: the inverse of the dense triangle on the diagonal, by rows, then `width` values for each row
/// below.
template <class T>
struct PackedTriangle {
  const Panel* panels;
  int panel_count;
  const int* rows;                             ///< of all panels, one after another
  const T* values;                             ///< of all panels, one after another
  std::size_t row_total = 0, value_total = 0;  ///< how many there are, where it is solved backwards alone
};

/// Rows of a dense matrix are kept in strips of so many: column after column of the strip, each contiguous.
inline constexpr int strip_rows = 8;

/// target −= rows·columnsᵀ for some strips of rows and one of columns. Strides are numbers from one strip to the next.
struct StripProduct {
  const double* rows;  ///< `depth` columns of each strip
  std::size_t row_stride;
  const double* columns;  ///< `depth` columns of one strip, whose rows are the columns of the target
  int depth;
  double* target;  ///< eight columns of each strip
  std::size_t target_stride;
  int strips;
};

/// The hot loops, compiled once for each instruction set. Every version gives the same bits: the same operations on
/// each element, sums in the same order, no fused multiply-add. Sums over many numbers are taken in eight interleaved
/// lanes.
struct Kernels {
  std::string_view name;  ///< "sse2", "avx2" or "avx512"
  int (*supported)();     ///< whether this processor can run them

  /// gradient += ∇E of the springs, E = Σ k/2 (‖x_i − x_j‖ − L)² [N]. The `value` versions return E [J].
  void (*add_list_gradient)(const SpringList&, Columns<const double> positions, Columns<double> gradient);
  double (*add_list_value_gradient)(const SpringList&, Columns<const double> positions, Columns<double> gradient);
  double (*add_band_value_gradient)(const SpringStretch&, Columns<const double> positions, Columns<double> gradient);
  /// Computes the gradient of inertia and bands; returns the value of both [J].
  double (*evaluate_bands)(const SpringStretch&, Columns<const double> positions, const SpringInertia&);
  /// Moves the vertices of a stretch by an explicit step. Stretches must be given in their order.
  void (*kick_bands)(const SpringStretch&, const SpringKick&);

  /// The springs' Hessian blocks at some positions, see SpringNetwork and share_across().
  void (*band_blocks)(const SpringBand&, int springs, double concavity, Columns<const double> positions, SpringBlocks);
  void (*list_blocks)(const SpringList&, double concavity, Columns<const double> positions, SpringBlocks);
  /// product += the springs' Hessian times `vector`; `blocks` has one entry for each band.
  void (*add_band_product)(const SpringStretch&, const ConstSpringBlocks* blocks, Columns<const double> vector,
                           Columns<double> product);
  void (*add_list_product)(const SpringList&, ConstSpringBlocks, Columns<const double> vector, Columns<double> product);

  /// to += factor[t]·from[t] for t < count.
  void (*add_scaled)(std::size_t count, const double* factor, const double* from, double* to);
  /// to += factor·from for count numbers.
  void (*add_multiple)(std::size_t count, double factor, const double* from, double* to);
  /// results[k] = Σ vectors[k][t]·with[t] for k < many, t < count.
  void (*dots)(std::size_t count, int many, const double* const* vectors, const double* with, double* results);
  /// to += Σ factors[k]·vectors[k] for k < many, count numbers each.
  void (*add_multiples)(std::size_t count, int many, const double* const* vectors, const double* factors, double* to);

  /// packed[4·row[v] + axis] = from[axis][v] for v < count; the fourth number of a row is zero.
  void (*pack_single)(int count, Columns<const double> from, const int* row, float* packed);
  void (*pack_double)(int count, Columns<const double> from, const int* row, double* packed);
  /// to[axis][v] = packed[4·row[v] + axis] for v < count.
  void (*unpack_single)(int count, const float* packed, const int* row, Columns<double> to);
  void (*unpack_double)(int count, const double* packed, const int* row, Columns<double> to);
  /// from[axis][v] −= packed[4·row[v] + axis] for v < count; returns the sum of the squares of what it subtracts.
  double (*subtract_packed_single)(int count, const float* packed, const int* row, Columns<double> from);
  double (*subtract_packed_double)(int count, const double* packed, const int* row, Columns<double> from);

  /// x = L⁻ᵀ L⁻¹ x for four right-hand sides, side by side in each row of x (4n numbers).
  void (*solve_single)(const PackedTriangle<float>&, float* x);
  void (*solve_double)(const PackedTriangle<double>&, double* x);
  /// x = L⁻¹ x alone, and x = L⁻ᵀ x.
  void (*forward_single)(const PackedTriangle<float>&, float* x);
  void (*forward_double)(const PackedTriangle<double>&, double* x);
  void (*backward_single)(const PackedTriangle<float>&, float* x);
  void (*backward_double)(const PackedTriangle<double>&, double* x);

  void (*subtract_product)(const StripProduct&);
  /// block := block L⁻ᵀ for `width` columns of some strips, `stride` numbers from one to the next. L's rows have eight
  /// numbers each in `triangle`, the diagonal as its reciprocals.
  void (*divide_strips)(const double* triangle, int width, double* block, std::size_t stride, int strips);
};

/// The fastest kernels this processor runs, at most those of limit_instruction_set().
const Kernels& kernels();

/// Makes kernels() return others from now on, which must live as long: to measure what they take. Not while another
/// thread computes.
/// @returns those that it replaces
const Kernels& replace_kernels(const Kernels& others);

/// Every version, slowest first; some may not run here.
std::span<const Kernels* const> all_kernels();

}  // namespace drape
