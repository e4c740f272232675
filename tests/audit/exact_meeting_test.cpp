// Meetings on a grid of small integers, where most cases are degenerate, compared with Sturm's theorem.

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "audit/passages.hpp"
#include "tests/audit/exact_roots.hpp"
#include "tests/support/random.hpp"

namespace drape::audit {
namespace {

using Vector = std::array<Integers, 3>;

/// Returns a path between two points with integer coordinates as polynomials in time.
Vector polynomial(const Way& way) {
  Vector v;
  for (int axis = 0; axis < 3; ++axis) {
    const auto from = static_cast<Integer>(way.from[axis]), to = static_cast<Integer>(way.to[axis]);
    v[static_cast<std::size_t>(axis)] = Integers{from} + Integers{0, 1} * (Integers{to} - Integers{from});
  }
  return v;
}

/// Returns to − from.
Vector between(const Vector& from, const Vector& to) { return {to[0] - from[0], to[1] - from[1], to[2] - from[2]}; }

Vector cross(const Vector& a, const Vector& b) {
  Vector c;
  for (std::size_t k = 0; k < 3; ++k) {
    c[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
  }
  return c;
}

Integers dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// Tests at each root of the volume, where a coordinate of `normal` is not zero, if all `weights`, vectors parallel to
/// it, have its sign or are zero. Absent if undecidable: always coplanar, or a normal of zero.
std::optional<bool> meets(const Integers& volume, const Vector& normal, const std::vector<Vector>& weights) {
  if (volume.empty()) return std::nullopt;
  bool met = false;
  for (const Root& root : roots_in_step(volume)) {
    bool decided = false;
    for (std::size_t k = 0; k < 3 && !decided; ++k) {
      const std::optional<int> side = sign_at(normal[k], root, volume);
      if (!side) return std::nullopt;
      if (*side == 0) continue;
      decided = true;
      bool all = true;
      for (const Vector& weight : weights) {
        const std::optional<int> sign = sign_at(weight[k], root, volume);
        if (!sign) return std::nullopt;
        all = all && *sign * *side >= 0;
      }
      met = met || all;
    }
    if (!decided) return std::nullopt;
  }
  return met;
}

std::optional<bool> vertex_meets(const std::array<Way, 4>& w) {
  const Vector p = polynomial(w[0]), a = polynomial(w[1]), b = polynomial(w[2]), c = polynomial(w[3]);
  const Vector normal = cross(between(a, b), between(a, c));
  return meets(
      dot(normal, between(a, p)), normal,
      {cross(between(a, b), between(a, p)), cross(between(b, c), between(b, p)), cross(between(c, a), between(c, p))});
}

// A common point a + s u = c + r v of two lines: s n = (c − a) × v and r n = (c − a) × u with n = u × v.
std::optional<bool> edges_meet_exactly(const std::array<Way, 4>& w) {
  const Vector a = polynomial(w[0]), c = polynomial(w[2]), u = between(a, polynomial(w[1])),
               v = between(c, polynomial(w[3])), ac = between(a, c);
  const Vector normal = cross(u, v), s = cross(ac, v), r = cross(ac, u);
  return meets(dot(normal, ac), normal, {s, between(s, normal), r, between(r, normal)});
}

Way random_way(test::Random& random, int size) {
  const auto whole = [&] { return static_cast<double>(random.below(2 * size + 1) - size); };
  const Eigen::Vector3d from(whole(), whole(), whole());
  return {from, {whole(), whole(), whole()}};
}

/// An exact, invertible integer map: features meet after it exactly where they met before.
struct AffineMap {
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Identity();
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();

  [[nodiscard]] Way operator()(const Way& way) const { return {matrix * way.from + shift, matrix * way.to + shift}; }
};

/// Makes a map with entries of 30 bits: exact areas have some 66 bits and volumes some 100, so doubles round them.
/// @param upright keeps vertical alignment, so that an area that is always zero stays zero
AffineMap large_map(bool upright, test::Random& random) {
  AffineMap map;
  do {
    for (double& entry : map.matrix.reshaped()) entry = std::floor(random.between(-0x1p30, 0x1p30));
    for (double& entry : map.shift) entry = std::floor(random.between(-0x1p45, 0x1p45));
    if (upright) map.matrix.row(2).head<2>().setZero(), map.matrix.col(2).head<2>().setZero();
  } while (std::abs(map.matrix.determinant()) < 0x1p80);
  return map;
}

/// Compares both kinds of features, original and mapped; returns the number of cases that only touch.
int compare(int size, int cases) {
  test::Random random(static_cast<std::uint64_t>(size));
  int undecided = 0, met = 0, touched = 0;
  for (int i = 0; i < cases; ++i) {
    std::array<Way, 4> w;
    for (Way& way : w) way = random_way(random, size);
    const bool vertex = i % 2 == 0;
    const std::optional<bool> expected = vertex ? vertex_meets(w) : edges_meet_exactly(w);
    undecided += static_cast<int>(!expected);
    if (!expected) continue;
    for (const AffineMap& map : {AffineMap{}, large_map(false, random), large_map(true, random)}) {
      std::array<Way, 4> m;
      std::ranges::transform(w, m.begin(), map);
      const auto meeting =
          vertex ? vertex_meets_triangle(m[0], {m[1], m[2], m[3]}) : edges_meet({m[0], m[1]}, {m[2], m[3]});
      EXPECT_EQ(meeting.has_value(), *expected) << "case " << i << " of size " << size;
      touched += static_cast<int>(meeting && meeting->touch);
    }
    met += static_cast<int>(*expected);
  }
  EXPECT_LT(undecided, cases / 2);
  EXPECT_GT(met, cases / 100);
  return touched;
}

TEST(ExactMeeting, OnTheSmallestGridIsSturms) { EXPECT_GT(compare(1, test::tries(6000)), test::tries(100)); }
TEST(ExactMeeting, OnASmallGridIsSturms) { EXPECT_GT(compare(2, test::tries(6000)), test::tries(50)); }
TEST(ExactMeeting, OnAGridIsSturms) { compare(9, test::tries(4000)); }

TEST(ExactRoots, AreThoseOfKnownPolynomials) {
  EXPECT_EQ(roots_in_step({0, -1, 3, -2}).size(), 3U);  // −t (1 − t) (1 − 2t)
  EXPECT_EQ(roots_in_step({3, -16, 16}).size(), 2U);    // 1/4, 3/4
  EXPECT_EQ(roots_in_step({1, -6, 9}).size(), 1U);      // 1/3, a double root
  EXPECT_EQ(roots_in_step({1, 1, 1}).size(), 0U);
  const Integers p{-1, 0, 0, 2};  // the cube root of 1/2
  const std::vector<Root> roots = roots_in_step(p);
  ASSERT_EQ(roots.size(), 1U);
  EXPECT_EQ(sign_at({-79, 100}, roots[0], p), 1);  // 0.7937
  EXPECT_EQ(sign_at({-80, 100}, roots[0], p), -1);
  EXPECT_EQ(sign_at(p * Integers{1, 1}, roots[0], p), 0);
}

}  // namespace
}  // namespace drape::audit
