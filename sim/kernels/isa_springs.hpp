#pragma once

// Spring laws, and loops over springs in any order. Only for inclusion by kernels_isa.cpp, see there.

#include "sim/kernels/isa_simd.hpp"
#include "sim/kernels/kernels.hpp"

namespace drape {
namespace {

/// Added to a squared length, so that a spring of zero length has zero direction and force instead of NaN [m²].
constexpr double tiny = 1e-30;

/// Returns √(x² + y² + z²). Square root and division are exactly rounded, so the same on every processor, unlike the
/// reciprocal instructions. Single-precision estimates refined by Newton steps are no faster.
template <class V>
inline V length(V x, V y, V z) {
  return square_root((x * x + tiny) + (y * y + z * z));
}

/// Force law for the difference d = x_i − x_j: ∇E = k(1 − L/‖d‖)·d on i and the opposite on j.
struct GradientLaw {
  const double* stiffness;
  const double* rest_length;

  template <class V>
  void operator()(int t, V& x, V& y, V& z) {
    const V factor = load<V>(stiffness + t) * (1.0 - load<V>(rest_length + t) / length(x, y, z));
    x *= factor;
    y *= factor;
    z *= factor;
  }
};

/// The same law, with the sum of E = k/2 (‖d‖ − L)².
struct ValueGradientLaw {
  const double* stiffness;
  const double* rest_length;
  LaneSum twice_energy;

  template <class V>
  void operator()(int t, V& x, V& y, V& z) {
    const V distance = length(x, y, z);
    const V k = load<V>(stiffness + t);
    const V stretch = distance - load<V>(rest_length + t);
    const V tension = k * stretch;
    twice_energy.add(t, tension * stretch);
    const V factor = tension / distance;
    x *= factor;
    y *= factor;
    z *= factor;
  }
};

/// Law that stores the Hessian block K = k(1 − s)·I + k·s·x̂x̂ᵀ, with s as in share_across(L/‖d‖, concavity).
struct BlockLaw {
  const double* stiffness;
  const double* rest_length;
  double concavity;
  SpringBlocks blocks;

  template <class V>
  void operator()(int t, V& x, V& y, V& z) {
    const V distance = length(x, y, z);
    const V k = load<V>(stiffness + t);
    const V ratio = load<V>(rest_length + t) / distance;
    const V positive = smaller(ratio, V{} + 1.0);
    const V share = k * (positive + concavity * (smaller(ratio, V{} + most_compressed) - positive));
    const V scale = square_root(share) / distance;  // for √share·x̂
    store<V>(blocks.across + t, k - share);
    store<V>(blocks.along.x + t, scale * x);
    store<V>(blocks.along.y + t, scale * y);
    store<V>(blocks.along.z + t, scale * z);
  }
};

/// Product K·d with the blocks stored by BlockLaw.
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

/// Calls a body for first … end−1, in whole vectors and then one by one.
template <class Body>
inline void for_range(int first, int end, Body&& body) {
  int t = first;
  for (; t + lanes <= end; t += lanes) body(t, Vector{});
  for (; t < end; ++t) body(t, double{});
}

/// Gathered differences of springs, which a law replaces by forces.
struct Gathered {
  alignas(64) double x[kernel_size];
  alignas(64) double y[kernel_size];
  alignas(64) double z[kernel_size];

  template <class Law>
  Gathered(const SpringList& list, Columns<const double> from, Law& law) {
    for (int t = 0; t < list.count; ++t) {
      const int i = list.i[t], j = list.j[t];
      x[t] = from.x[i] - from.x[j];
      y[t] = from.y[i] - from.y[j];
      z[t] = from.z[i] - from.z[j];
    }
    for_range(0, list.count, [&]<class V>(int t, V) {
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
  if (list.force.x != nullptr) {
    const auto bytes = sizeof(double) * static_cast<unsigned>(list.count);
    __builtin_memcpy(list.force.x, force.x, bytes);
    __builtin_memcpy(list.force.y, force.y, bytes);
    __builtin_memcpy(list.force.z, force.z, bytes);
    return;
  }
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

void add_list_gradient(const SpringList& list, Columns<const double> positions, Columns<double> gradient) {
  GradientLaw law{list.stiffness, list.rest_length};
  scatter(list, positions, gradient, law);
}

double add_list_value_gradient(const SpringList& list, Columns<const double> positions, Columns<double> gradient) {
  ValueGradientLaw law{list.stiffness, list.rest_length, {}};
  scatter(list, positions, gradient, law);
  return 0.5 * law.twice_energy.total();
}

void add_list_product(const SpringList& list, ConstSpringBlocks blocks, Columns<const double> vector,
                      Columns<double> product) {
  ProductLaw law{blocks};
  scatter(list, vector, product, law);
}

void list_blocks(const SpringList& list, double concavity, Columns<const double> positions, SpringBlocks blocks) {
  BlockLaw law{list.stiffness, list.rest_length, concavity, blocks};
  [[maybe_unused]] const Gathered unused(list, positions, law);
}

}  // namespace
}  // namespace drape
