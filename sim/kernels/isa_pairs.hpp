#pragma once

// Rejection of distant pairs of features. Only for inclusion by kernels_isa.cpp, see there.

#include "sim/kernels/isa_triangle.hpp"
#include "sim/kernels/kernels.hpp"

namespace drape {
namespace {

constexpr int pair_lanes = 8;

/// Vectors of eight pairs.
struct EightVectors {
  EightSingles x, y, z;
};

inline EightVectors operator+(const EightVectors& a, const EightVectors& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline EightVectors operator-(const EightVectors& a, const EightVectors& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline EightVectors operator*(EightSingles s, const EightVectors& a) { return {s * a.x, s * a.y, s * a.z}; }
inline EightSingles dot(const EightVectors& a, const EightVectors& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

inline EightSingles least(EightSingles a, EightSingles b) { return a < b ? a : b; }
inline EightSingles largest(EightSingles a, EightSingles b) { return a > b ? a : b; }
inline EightSingles to_unit_interval(EightSingles s) {
  const EightSingles zero{}, one = zero + 1.0F;
  return least(largest(zero, s), one);
}
template <class Condition>
inline EightVectors choose(Condition condition, const EightVectors& a, const EightVectors& b) {
  return {condition ? a.x : b.x, condition ? a.y : b.y, condition ? a.z : b.z};
}

/// Four points of eight pairs, relative to one of the four.
struct EightPairs {
  EightVectors points[4];
};

/// Returns the points at the start of the paths, or at the end.
/// @param vertices four of each pair
template <bool end, int origin>
inline EightPairs load_pairs(const float* rows, const int* const* vertices) {
  const auto* all = reinterpret_cast<const FourSingles*>(rows);
  EightPairs pairs;
  for (int point = 0; point < 4; ++point) {
    int row[pair_lanes];
    for (int lane = 0; lane < pair_lanes; ++lane) row[lane] = 2 * vertices[lane][point] + (end ? 1 : 0);
    const FourVertices<FourSingles> low = load_rows(all, row), high = load_rows(all, row + 4);
    pairs.points[point] = {join(low.x, high.x), join(low.y, high.y), join(low.z, high.z)};
  }
  const EightVectors from = pairs.points[origin];
  for (EightVectors& point : pairs.points) point = point - from;
  return pairs;
}

/// Two edges. An axis is any vector: only the number of rejected pairs depends on its accuracy.
struct EdgePair {
  static constexpr int origin = 2;

  /// Returns the difference of the closest points (Ericson 2005, section 5.1.9).
  static EightVectors axis(const EightVectors* p) {
    const EightVectors first = p[1] - p[0], second = p[3];
    const EightSingles zero{};
    const EightSingles a = dot(first, first), e = dot(second, second), b = dot(first, second), c = dot(first, p[0]);
    const EightSingles f = dot(second, p[0]), cross = a * e - b * b;
    const EightSingles on_lines = cross > zero ? (b * f - c * e) / cross : zero;
    const EightSingles t = to_unit_interval((b * to_unit_interval(on_lines) + f) / e);
    const EightSingles s = to_unit_interval((b * t - c) / a);
    return p[0] + s * first - t * second;
  }
  /// Returns the width of the slab between the edges, scaled by the length of the axis.
  static EightSingles gap(const EightVectors& axis, const EightVectors* p) {
    const EightSingles zero{};
    return least(dot(axis, p[0]), dot(axis, p[1])) - largest(zero, dot(axis, p[3]));
  }
};

/// A vertex and a triangle.
struct VertexTrianglePair {
  static constexpr int origin = 1;

  static EightVectors axis(const EightVectors* p) {
    const EightVectors &ab = p[2], &ac = p[3], &to = p[0], bc = ac - ab, from_b = to - ab;
    const EightSingles zero{}, one = zero + 1.0F;
    const EightSingles bb = dot(ab, ab), bac = dot(ab, ac), cc = dot(ac, ac), tob = dot(to, ab), toc = dot(to, ac);
    const EightVectors on_ab = to - to_unit_interval(tob / bb) * ab, on_ac = to - to_unit_interval(toc / cc) * ac;
    const EightVectors on_bc = from_b - to_unit_interval(dot(from_b, bc) / dot(bc, bc)) * bc;
    const EightVectors on_first = choose(dot(on_ab, on_ab) < dot(on_ac, on_ac), on_ab, on_ac);
    const EightVectors on_edge = choose(dot(on_bc, on_bc) < dot(on_first, on_first), on_bc, on_first);
    const EightSingles area = bb * cc - bac * bac;
    const EightSingles v = (cc * tob - bac * toc) / area, w = (bb * toc - bac * tob) / area;
    const auto inside = (v >= zero) & (w >= zero) & (v + w <= one);
    return choose(inside, to - v * ab - w * ac, on_edge);
  }
  static EightSingles gap(const EightVectors& axis, const EightVectors* p) {
    const EightSingles zero{};
    return dot(axis, p[0]) - largest(zero, largest(dot(axis, p[2]), dot(axis, p[3])));
  }
};

template <class Pair>
int find_near(const PairPaths& pairs, int* near) {
  const EightSingles reach = EightSingles{} + pairs.reach * pairs.reach, zero{};
  int found = 0;
  for (int first = 0; first < pairs.count; first += pair_lanes) {
    const int* vertices[pair_lanes];
    const int last = pairs.count - 1 - first;  // its lane; further lanes repeat it
    for (int lane = 0; lane < pair_lanes; ++lane) {
      vertices[lane] = pairs.vertices + pairs.stride * (first + (lane < last ? lane : last));
    }
    const EightPairs start = load_pairs<false, Pair::origin>(pairs.rows, vertices);
    const EightPairs end = load_pairs<true, Pair::origin>(pairs.rows, vertices);
    EightVectors middle[4];  // twice the points in the middle of the paths
    for (int point = 0; point < 4; ++point) middle[point] = start.points[point] + end.points[point];
    const EightVectors axis = Pair::axis(middle);
    const EightSingles squared = dot(axis, axis);
    const EightSingles gap = least(Pair::gap(axis, start.points), Pair::gap(axis, end.points));
    // An axis shorter than the reach belongs to features nearer than it, and its square may underflow.
    const auto apart = (gap > zero) & (squared > reach) & (gap * gap > reach * squared);
    for (int lane = 0; lane < pair_lanes && lane <= last; ++lane) {
      near[found] = first + lane;
      found += apart[lane] == 0 ? 1 : 0;
    }
  }
  return found;
}

}  // namespace
}  // namespace drape
