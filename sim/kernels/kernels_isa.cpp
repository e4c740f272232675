// Compiled once per instruction set: DRAPE_KERNELS is its name, DRAPE_LANES the number of doubles in a vector register.
// Only the table may have external linkage here. Nothing else may be defined or instantiated with it, not even a
// header's inline function. The linker would keep one copy for the whole program, possibly one that an older processor
// cannot run.

#include "sim/kernels/isa_pairs.hpp"
#include "sim/kernels/isa_simd.hpp"
#include "sim/kernels/isa_springs.hpp"
#include "sim/kernels/isa_strips.hpp"
#include "sim/kernels/isa_triangle.hpp"
#include "sim/kernels/kernels.hpp"

namespace drape {

#define DRAPE_JOIN_(a, b) a##b
#define DRAPE_JOIN(a, b) DRAPE_JOIN_(a, b)
#define DRAPE_TABLE DRAPE_JOIN(kernels_, DRAPE_KERNELS)
#define DRAPE_STRING_(a) #a
#define DRAPE_STRING(a) DRAPE_STRING_(a)

extern const Kernels DRAPE_TABLE;

namespace {

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
    .add_list_gradient = add_list_gradient,
    .add_list_value_gradient = add_list_value_gradient,
    .add_band_value_gradient = add_band_value_gradient,
    .evaluate_bands = evaluate_bands,
    .kick_bands = kick_bands,
    .band_blocks = band_blocks,
    .list_blocks = list_blocks,
    .add_band_product = add_band_product,
    .add_list_product = add_list_product,
    .add_scaled = add_scaled,
    .add_multiple = add_multiple,
    .drift = drift,
    .dots = dots,
    .add_multiples = add_multiples,
    .pack_single = pack<FourSingles, float>,
    .pack_double = pack<FourDoubles, double>,
    .unpack_single = unpack<FourSingles, float>,
    .unpack_double = unpack<FourDoubles, double>,
    .subtract_packed_single = subtract_packed<FourSingles, float>,
    .subtract_packed_double = subtract_packed<FourDoubles, double>,
    .solve_single = solve_packed<FourSingles, float>,
    .solve_double = solve_packed<FourDoubles, double>,
    .forward_single = solve_forward<FourSingles, float>,
    .forward_double = solve_forward<FourDoubles, double>,
    .backward_single = solve_backward<FourSingles, float>,
    .backward_double = solve_backward<FourDoubles, double>,
    .subtract_product = subtract_product,
    .divide_strips = divide_strips,
    .near_edges = find_near<EdgePair>,
    .near_vertices = find_near<VertexTrianglePair>,
};

}  // namespace drape
