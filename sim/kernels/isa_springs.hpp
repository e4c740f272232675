#pragma once

// Spring laws, and loops over springs in any order and in bands. Only for inclusion by kernels_isa.cpp, see there.

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

// Springs in bands, for one stretch of vertices at a time.
//
// A vertex v receives the force of a band's spring v and the opposite force of spring v − offset. The loop over a band
// computes its forces, stores them, and subtracts those of the previous band. These were written long enough ago that
// no read waits for a write. A spring's square root and division take longer than the rest of the loop, so the sums are
// free. The loop is short, so many springs are processed concurrently.

/// Three coordinates of a vertex.
template <class V>
struct Triple {
  V x, y, z;
};

template <class V>
inline Triple<V> load_triple(Columns<const double> from, int t) {
  return {load<V>(from.x + t), load<V>(from.y + t), load<V>(from.z + t)};
}
template <class V>
inline void store_triple(Columns<double> to, int t, const Triple<V>& value) {
  store<V>(to.x + t, value.x);
  store<V>(to.y + t, value.y);
  store<V>(to.z + t, value.z);
}
template <class V>
inline Triple<V> operator-(const Triple<V>& a, const Triple<V>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class V>
inline void operator+=(Triple<V>& sum, const Triple<V>& term) {
  sum.x += term.x;
  sum.y += term.y;
  sum.z += term.z;
}
inline Columns<const double> constant(Columns<double> c) { return {c.x, c.y, c.z}; }

/// First band: sum = its forces.
struct NoBandBefore {
  template <class V>
  void add(Columns<double>, int, Triple<V>&) const {}
};

/// Later bands: sum += its forces minus the opposite forces of the previous band.
struct BandBefore {
  SpringBand band;

  template <class V>
  void add(Columns<double> sum, int t, Triple<V>& total) const {
    total += load_triple<V>(constant(sum), t) - load_triple<V>(constant(band.force), t - band.offset);
  }
};

/// Computes the forces of one band and adds them up. They are zero if the cloth has no vertices for their other ends.
template <class Law, class Before>
inline void add_band(const SpringBand band, int count, int springs, Columns<const double> from, Law& shared,
                     const Before before, Columns<double> sum) {
  Law law = shared;
  for_range(0, springs, [&]<class V>(int t, V) {
    Triple<V> force = load_triple<V>(from, t) - load_triple<V>(from, t + band.offset);
    law(t, force.x, force.y, force.z);
    store_triple(band.force, t, force);
    before.add(sum, t, force);
    store_triple(sum, t, force);
  });
  for_range(springs, count, [&]<class V>(int t, V) {
    Triple<V> none{};
    store_triple(band.force, t, none);
    before.add(sum, t, none);
    store_triple(sum, t, none);
  });
  shared = law;
}

/// Computes every band of a stretch with its law, and passes each vertex's position and sum to `finish`.
template <class Law, class Finish>
inline void sweep(const SpringStretch& stretch, Columns<const double> from, Law* laws, Finish& shared) {
  alignas(64) double sums[3][kernel_size];
  const Columns<double> sum{sums[0], sums[1], sums[2]};
  Finish finish = shared;
  for (int b = 0; b < stretch.band_count; ++b) {
    const SpringBand& band = stretch.bands[b];
    const int there = stretch.count + stretch.vertices_after - band.offset;
    const int springs = there < 0 ? 0 : there < stretch.count ? there : stretch.count;
    if (b == 0) {
      add_band(band, stretch.count, springs, from, laws[b], NoBandBefore{}, sum);
    } else {
      add_band(band, stretch.count, springs, from, laws[b], BandBefore{stretch.bands[b - 1]}, sum);
    }
  }
  if (stretch.band_count == 0) {
    for_range(0, stretch.count, [&]<class V>(int t, V) { finish(t, load_triple<V>(from, t), Triple<V>{}); });
  } else {
    const BandBefore last{stretch.bands[stretch.band_count - 1]};
    for_range(0, stretch.count, [&]<class V>(int t, V) {
      Triple<V> total{};
      last.add(sum, t, total);
      finish(t, load_triple<V>(from, t), total);
    });
  }
  shared = finish;
}

struct AddTo {
  Columns<double> to;

  template <class V>
  void operator()(int t, const Triple<V>&, Triple<V> sum) {
    sum += load_triple<V>(constant(to), t);
    store_triple(to, t, sum);
  }
};

struct KickAndDrift {
  SpringKick k;
  LaneSum squares{};

  template <class V>
  void operator()(int t, const Triple<V>& at, const Triple<V>& sum) {
    const V factor = load<V>(k.factor + t);
    const V x = axis(t, factor, at.x, sum.x, k.force.x, k.velocity.x, k.position.x);
    const V y = axis(t, factor, at.y, sum.y, k.force.y, k.velocity.y, k.position.y);
    const V z = axis(t, factor, at.z, sum.z, k.force.z, k.velocity.z, k.position.z);
    squares.add(t, x * x + y * y + z * z);
  }

 private:
  /// Returns the new position.
  template <class V>
  V axis(int t, V factor, V at, V sum, const double* force, double* velocity, double* position) const {
    const V v = k.drift.before * (load<V>(velocity + t) + factor * (sum - load<V>(force + t)));
    const V to = at + k.drift.h * v;
    store<V>(velocity + t, k.drift.after * v);
    store<V>(position + t, to);
    return to;
  }
};

struct AddInertia {
  SpringInertia i;
  LaneSum twice_energy{};

  template <class V>
  void operator()(int t, const Triple<V>& at, Triple<V> sum) {
    const V factor = load<V>(i.factor + t);
    const Triple<V> d = at - load_triple<V>(i.y, t);
    const Triple<V> pull{factor * d.x, factor * d.y, factor * d.z};
    twice_energy.add(t, d.x * pull.x + d.y * pull.y + d.z * pull.z);
    sum += pull;
    store_triple(i.gradient, t, sum);
  }
};

inline GradientLaw* laws_of(const SpringStretch& stretch, GradientLaw* laws) {
  for (int b = 0; b < stretch.band_count; ++b) laws[b] = {stretch.bands[b].stiffness, stretch.bands[b].rest_length};
  return laws;
}
inline ValueGradientLaw* laws_of(const SpringStretch& stretch, ValueGradientLaw* laws) {
  for (int b = 0; b < stretch.band_count; ++b) laws[b] = {stretch.bands[b].stiffness, stretch.bands[b].rest_length, {}};
  return laws;
}

inline double energy_of(const SpringStretch& stretch, const ValueGradientLaw* laws) {
  double twice = 0;
  for (int b = 0; b < stretch.band_count; ++b) twice += laws[b].twice_energy.total();
  return twice;
}

double add_band_value_gradient(const SpringStretch& stretch, Columns<const double> positions,
                               Columns<double> gradient) {
  ValueGradientLaw laws[max_bands];
  AddTo finish{gradient};
  sweep(stretch, positions, laws_of(stretch, laws), finish);
  return 0.5 * energy_of(stretch, laws);
}

double evaluate_bands(const SpringStretch& stretch, Columns<const double> positions, const SpringInertia& inertia) {
  ValueGradientLaw laws[max_bands];
  AddInertia finish{inertia};
  sweep(stretch, positions, laws_of(stretch, laws), finish);
  return 0.5 * (finish.twice_energy.total() + energy_of(stretch, laws));
}

double kick_bands(const SpringStretch& stretch, const SpringKick& kick) {
  GradientLaw laws[max_bands];
  KickAndDrift finish{kick};
  sweep(stretch, kick.from, laws_of(stretch, laws), finish);
  return finish.squares.total();
}

void add_band_product(const SpringStretch& stretch, const ConstSpringBlocks* blocks, Columns<const double> vector,
                      Columns<double> product) {
  ProductLaw laws[max_bands];
  for (int b = 0; b < stretch.band_count; ++b) laws[b].blocks = blocks[b];
  AddTo finish{product};
  sweep(stretch, vector, laws, finish);
}

void band_blocks(const SpringBand& band, int springs, double concavity, Columns<const double> positions,
                 SpringBlocks blocks) {
  BlockLaw law{band.stiffness, band.rest_length, concavity, blocks};
  for_range(0, springs, [&]<class V>(int t, V) {
    Triple<V> d = load_triple<V>(positions, t) - load_triple<V>(positions, t + band.offset);
    law(t, d.x, d.y, d.z);
  });
}

}  // namespace
}  // namespace drape
