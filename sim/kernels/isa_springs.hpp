#pragma once

// Loops over springs. Included by kernels_isa.cpp only, see there.

#include "sim/kernels/isa_simd.hpp"
#include "sim/kernels/kernels.hpp"

namespace drape {
namespace {

/// Added to a squared length, so that a spring of zero length has a direction and a force of zero, not NaN [m²].
constexpr double tiny = 1e-30;

/// What a spring does with the difference d = x_i − x_j: ∇E = k(1 − L/‖d‖)·d on i and the opposite on j.
struct GradientLaw {
  const double* stiffness;
  const double* rest_length;

  template <class V>
  void operator()(int t, V& x, V& y, V& z) {
    const V squared = x * x + y * y + z * z + tiny;
    const V factor = load<V>(stiffness + t) * (1.0 - load<V>(rest_length + t) * inverse_root(squared));
    x *= factor;
    y *= factor;
    z *= factor;
  }
};

/// The same, and the sum of E = k/2 (‖d‖ − L)².
struct ValueGradientLaw {
  const double* stiffness;
  const double* rest_length;
  LaneSum twice_energy{};

  template <class V>
  void operator()(int t, V& x, V& y, V& z) {
    const V squared = x * x + y * y + z * z + tiny;
    const V inverse = inverse_root(squared);
    const V k = load<V>(stiffness + t), rest = load<V>(rest_length + t);
    const V stretch = squared * inverse - rest;
    twice_energy.add(t, k * stretch * stretch);
    const V factor = k * (1.0 - rest * inverse);
    x *= factor;
    y *= factor;
    z *= factor;
  }
};

/// Keeps the Hessian block K = k·max(0, 1 − L/‖d‖)·I + k·min(1, L/‖d‖)·x̂x̂ᵀ.
struct BlockLaw {
  const double* stiffness;
  const double* rest_length;
  SpringBlocks blocks;

  template <class V>
  void operator()(int t, V& x, V& y, V& z) {
    const V squared = x * x + y * y + z * z + tiny;
    const V inverse = inverse_root(squared);
    const V k = load<V>(stiffness + t);
    const V along = smaller(load<V>(rest_length + t) * inverse, V{} + 1.0);
    const V share = k * along;
    // √share·x̂, where √share = share/√share.
    const V scale = share * inverse_root(share + tiny) * inverse;
    store<V>(blocks.across + t, k - share);
    store<V>(blocks.along.x + t, scale * x);
    store<V>(blocks.along.y + t, scale * y);
    store<V>(blocks.along.z + t, scale * z);
  }
};

/// K·d with the blocks that BlockLaw kept.
struct ProductLaw {
  ConstSpringBlocks blocks;

  template <class V>
  void operator()(int t, V& x, V& y, V& z) {
    const V a = load<V>(blocks.along.x + t), b = load<V>(blocks.along.y + t), c = load<V>(blocks.along.z + t);
    const V projection = a * x + b * y + c * z;
    const V across = load<V>(blocks.across + t);
    x = across * x + projection * a;
    y = across * y + projection * b;
    z = across * z + projection * c;
  }
};

/// Applies a body to the springs 0 … count−1, a vector at a time and the rest one by one.
template <class Body>
inline void for_springs(int count, Body&& body) {
  int t = 0;
  for (; t + lanes <= count; t += lanes) body(t, Vector{});
  for (; t < count; ++t) body(t, double{});
}

template <class V, class Law>
inline void apply(Law& law, int t, const SpringRun& run, Columns<const double> from, V& x, V& y, V& z) {
  x = load<V>(from.x + run.i + t) - load<V>(from.x + run.j + t);
  y = load<V>(from.y + run.i + t) - load<V>(from.y + run.j + t);
  z = load<V>(from.z + run.i + t) - load<V>(from.z + run.j + t);
  law(t, x, y, z);
}

// Where the ends of a run lie at least so far apart, a vector of springs adds to both ends at once. Where they are
// nearer, it would wait for what the vectors before it wrote.
constexpr int far_apart = 16;

template <class Law>
inline void scatter_far(const SpringRun& run, Columns<const double> from, Columns<double> to, Law& law) {
  for_springs(run.count, [&]<class V>(int t, V) {
    V x, y, z;
    apply(law, t, run, from, x, y, z);
    const int i = run.i + t, j = run.j + t;
    store<V>(to.x + i, load<V>(to.x + i) + x);
    store<V>(to.y + i, load<V>(to.y + i) + y);
    store<V>(to.z + i, load<V>(to.z + i) + z);
    store<V>(to.x + j, load<V>(to.x + j) - x);
    store<V>(to.y + j, load<V>(to.y + j) - y);
    store<V>(to.z + j, load<V>(to.z + j) - z);
  });
}

inline void add_shifted_difference(const double* __restrict from, int shift, int count, double* __restrict to) {
  for (int t = 0; t < count + shift; ++t) to[t] += from[shift + t] - from[t];
}

/// The springs' forces between two margins of zeros: vertex v receives force v − i and gives back force v − j.
template <class Law>
inline void scatter_near(const SpringRun& run, Columns<const double> from, Columns<double> to, Law& law) {
  constexpr int size = kernel_springs + 2 * far_apart;
  alignas(64) double x[size], y[size], z[size];
  const int shift = run.j - run.i;
  for (double* force : {x, y, z}) {
    for (int t = 0; t < shift; ++t) force[t] = force[shift + run.count + t] = 0;
  }
  for_springs(run.count, [&]<class V>(int t, V) {
    V fx, fy, fz;
    apply(law, t, run, from, fx, fy, fz);
    store<V>(x + shift + t, fx);
    store<V>(y + shift + t, fy);
    store<V>(z + shift + t, fz);
  });
  add_shifted_difference(x, shift, run.count, to.x + run.i);
  add_shifted_difference(y, shift, run.count, to.y + run.i);
  add_shifted_difference(z, shift, run.count, to.z + run.i);
}

template <class Law>
inline void scatter(const SpringRun& run, Columns<const double> from, Columns<double> to, Law& law) {
  if (run.j - run.i >= far_apart) {
    scatter_far(run, from, to, law);
  } else {
    scatter_near(run, from, to, law);
  }
}

/// The law of some springs, with their differences gathered before and their forces left in the same place.
struct Gathered {
  alignas(64) double x[kernel_springs];
  alignas(64) double y[kernel_springs];
  alignas(64) double z[kernel_springs];

  template <class Law>
  Gathered(const SpringList& list, Columns<const double> from, Law& law) {
    for (int t = 0; t < list.count; ++t) {
      const int i = list.i[t], j = list.j[t];
      x[t] = from.x[i] - from.x[j];
      y[t] = from.y[i] - from.y[j];
      z[t] = from.z[i] - from.z[j];
    }
    for_springs(list.count, [&]<class V>(int t, V) {
      V fx = load<V>(x + t), fy = load<V>(y + t), fz = load<V>(z + t);
      law(t, fx, fy, fz);
      store<V>(x + t, fx);
      store<V>(y + t, fy);
      store<V>(z + t, fz);
    });
  }
};

template <class Law>
inline void scatter(const SpringList& list, Columns<const double> from, Columns<double> to, Law& law) {
  const Gathered force(list, from, law);
  for (int t = 0; t < list.count; ++t) {
    const int i = list.i[t], j = list.j[t];
    to.x[i] += force.x[t];
    to.y[i] += force.y[t];
    to.z[i] += force.z[t];
    to.x[j] -= force.x[t];
    to.y[j] -= force.y[t];
    to.z[j] -= force.z[t];
  }
}

template <class Springs>
void add_gradient(const Springs& springs, Columns<const double> positions, Columns<double> gradient) {
  GradientLaw law{springs.stiffness, springs.rest_length};
  scatter(springs, positions, gradient, law);
}

template <class Springs>
double add_value_gradient(const Springs& springs, Columns<const double> positions, Columns<double> gradient) {
  ValueGradientLaw law{springs.stiffness, springs.rest_length};
  scatter(springs, positions, gradient, law);
  return 0.5 * law.twice_energy.total();
}

template <class Springs>
void add_product(const Springs& springs, ConstSpringBlocks blocks, Columns<const double> vector,
                 Columns<double> product) {
  ProductLaw law{blocks};
  scatter(springs, vector, product, law);
}

void run_blocks(const SpringRun& run, Columns<const double> positions, SpringBlocks blocks) {
  BlockLaw law{run.stiffness, run.rest_length, blocks};
  for_springs(run.count, [&]<class V>(int t, V) {
    V x, y, z;
    apply(law, t, run, positions, x, y, z);
  });
}

void list_blocks(const SpringList& list, Columns<const double> positions, SpringBlocks blocks) {
  BlockLaw law{list.stiffness, list.rest_length, blocks};
  [[maybe_unused]] const Gathered unused(list, positions, law);
}

}  // namespace
}  // namespace drape
