// Meetings of two features in a step: known cases, exact borders, and random motions compared with sampled roots.

#include "audit/passages.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <vector>

#include "tests/support/random.hpp"

namespace drape::audit {
namespace {

using Eigen::Vector3d;

Way still(double x, double y, double z) { return {{x, y, z}, {x, y, z}}; }

const std::array<Way, 3> floor_triangle{still(0, 0, 0), still(1, 0, 0), still(0, 1, 0)};

TEST(Meeting, OfAVertexThatFallsThroughATriangle) {
  const auto meeting = vertex_meets_triangle({{0.2, 0.2, 1}, {0.2, 0.2, -3}}, floor_triangle);
  ASSERT_TRUE(meeting);
  EXPECT_NEAR(meeting->time, 0.25, 1e-12);
  EXPECT_FALSE(meeting->touch);
  EXPECT_FALSE(vertex_meets_triangle({{0.2, 0.2, 1}, {0.2, 0.2, 0.001}}, floor_triangle));
  EXPECT_FALSE(vertex_meets_triangle({{0.6, 0.6, 1}, {0.6, 0.6, -3}}, floor_triangle));
}

// The triangle tilts up while the vertex above it moves down its slope: the volume is (t − 1/4)(t − 3/4) times an area.
TEST(Meeting, OfAVertexThatGoesInAndOutWithinTheStep) {
  const std::array<Way, 3> tilting{still(-1, -1, 0), still(1, -1, 0), Way{{0, 2, 0}, {0, 2, 3}}};
  const auto meeting = vertex_meets_triangle({{0, 1, 3.0 / 16}, {0, 0, 1 + 3.0 / 16}}, tilting);
  ASSERT_TRUE(meeting);
  EXPECT_NEAR(meeting->time, 0.25, 1e-12);
  EXPECT_FALSE(vertex_meets_triangle({{0, 1, 0.2501}, {0, 0, 1.2501}}, tilting));
  EXPECT_TRUE(vertex_meets_triangle({{0, 1, 0.25}, {0, 0, 1.25}}, tilting)) << "a double root: it touches";
}

TEST(Meeting, OfEdgesThatSwap) {
  const std::array<Way, 2> first{Way{{-1, 0, 0.1}, {-1, 0, -0.1}}, Way{{1, 0, 0.1}, {1, 0, -0.1}}};
  const std::array<Way, 2> second{still(0, -1, 0), still(0, 1, 0)};
  const auto meeting = edges_meet(first, second);
  ASSERT_TRUE(meeting);
  EXPECT_NEAR(meeting->time, 0.5, 1e-12);
  EXPECT_FALSE(edges_meet(first, {still(0, 0.001, 0), still(0, 1, 0)}));
  EXPECT_FALSE(edges_meet(first, {still(2, -1, 0), still(2, 1, 0)}));
}

TEST(Meeting, CountsTouching) {
  const auto on_border = vertex_meets_triangle({{0.5, 0, 1}, {0.5, 0, -1}}, floor_triangle);
  ASSERT_TRUE(on_border);
  EXPECT_TRUE(on_border->touch);
  EXPECT_TRUE(vertex_meets_triangle({{0.2, 0.2, 1}, {0.2, 0.2, 0}}, floor_triangle)) << "at the end of the step";
  EXPECT_TRUE(vertex_meets_triangle(still(0.2, 0.2, 0), floor_triangle)) << "at rest on it";
  EXPECT_TRUE(vertex_meets_triangle(still(1, 0, 0), floor_triangle)) << "at rest at its corner";
  EXPECT_FALSE(vertex_meets_triangle({{0.2, 0.2, 1}, {0.2, 0.2, 1e-60}}, floor_triangle));
  EXPECT_FALSE(vertex_meets_triangle({{0.5, -1e-60, 1}, {0.5, -1e-60, -1}}, floor_triangle));
  EXPECT_TRUE(edges_meet({still(0, 0, 0), still(1, 0, 0)}, {still(1, 0, 0), still(2, 0, 0)})) << "in a line";
  EXPECT_FALSE(edges_meet({still(0, 0, 0), still(1, 0, 0)}, {still(1 + 1e-15, 0, 0), still(2, 0, 0)}));
  EXPECT_TRUE(edges_meet({still(0, 0, 0), still(2, 0, 0)}, {still(1, 0, 0), still(3, 0, 0)})) << "over each other";
  EXPECT_FALSE(edges_meet({still(0, 0, 0), still(2, 0, 0)}, {still(0, 1e-60, 0), still(2, 1e-60, 0)})) << "parallel";
}

// Motion in one plane: the volume is always zero, and only the areas decide.
TEST(Meeting, OfFeaturesThatMoveInOnePlane) {
  EXPECT_TRUE(vertex_meets_triangle({{-1, 0.2, 0}, {0.1, 0.2, 0}}, floor_triangle));
  EXPECT_FALSE(vertex_meets_triangle({{-1, 0.2, 0}, {-0.001, 0.2, 0}}, floor_triangle));
  EXPECT_FALSE(vertex_meets_triangle({{2, -0.5, 0}, {-0.5, 2.1, 0}}, floor_triangle)) << "along the long side";
  EXPECT_TRUE(vertex_meets_triangle({{2, -0.6, 0}, {-0.5, 1.4, 0}}, floor_triangle));
}

TEST(Meeting, OfTrianglesWithoutAnArea) {
  const std::array<Way, 3> line{still(0, 0, 0), still(1, 1, 1), still(2, 2, 2)};
  const std::array<Way, 3> dot{still(1, 1, 1), still(1, 1, 1), still(1, 1, 1)};
  EXPECT_TRUE(vertex_meets_triangle({{1.5, 0, 1.5}, {1.5, 3, 1.5}}, line));
  EXPECT_FALSE(vertex_meets_triangle({{1.5, 0, 1.6}, {1.5, 3, 1.6}}, line));
  EXPECT_FALSE(vertex_meets_triangle({{2.5, 0, 2.5}, {2.5, 5, 2.5}}, line));
  EXPECT_TRUE(vertex_meets_triangle({{0, 1, 1}, {3, 1, 1}}, dot));
  EXPECT_FALSE(vertex_meets_triangle({{0, 1, 1}, {3, 1, 1.001}}, dot));
}

double at(double from, double to, double t) { return (1 - t) * from + t * to; }

// A vertex passes the side of a triangle at exactly a third of the step. Its positions are multiples of 2⁻⁴⁰, but the
// crossing is not.
TEST(Meeting, TellsOnePlaceBesideTheBorderFromTheBorder) {
  test::Random random;
  for (int i = 0; i < test::tries(300); ++i) {
    const auto whole = [&] { return std::floor(random.between(-1000, 1000)); };
    // At t = 1/3 the vertex is at (2 from + to)/3 = a + m (b − a) with m = 1/2, and the triangle is at rest; all
    // integers.
    const Vector3d a(2 * whole(), 2 * whole(), 2 * whole()), b(2 * whole(), 2 * whole(), 2 * whole());
    const Vector3d c(whole(), whole(), whole()), from(whole(), whole(), whole());
    const Vector3d to = 3 * (a + b) / 2 - 2 * from;
    const std::array<Way, 3> triangle{Way{a, a}, Way{b, b}, Way{c, c}};
    const auto meeting = vertex_meets_triangle({from, to}, triangle);
    ASSERT_TRUE(meeting) << i;
    EXPECT_TRUE(meeting->touch);
    EXPECT_NEAR(meeting->time, 1.0 / 3, 1e-9);
    // Moved away from c by the smallest amount it misses; moved towards c it passes.
    const Vector3d out = 0x1p-36 * (a + b - 2 * c);
    EXPECT_FALSE(vertex_meets_triangle({from + out, to + out}, triangle)) << i;
    const auto inner = vertex_meets_triangle({from - out, to - out}, triangle);
    ASSERT_TRUE(inner) << i;
    EXPECT_FALSE(inner->touch);
  }
}

/// Returns the smallest sampled distance of two moving features over a fine grid of times: an upper bound of the true
/// one.
template <class Distance>
double least(Distance distance) {
  double smallest = HUGE_VAL;
  for (int i = 0; i <= 400; ++i) smallest = std::min(smallest, distance(i / 400.0));
  return smallest;
}

double distance(const Vector3d& p, const Vector3d& a, const Vector3d& b) {
  const double s = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return (a + s * (b - a) - p).norm();
}

double distance(const Vector3d& p, const std::array<Vector3d, 3>& t) {
  const Vector3d normal = (t[1] - t[0]).cross(t[2] - t[0]).normalized();
  double border = HUGE_VAL;
  bool above = true;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector3d &a = t[k], &b = t[(k + 1) % 3];
    border = std::min(border, distance(p, a, b));
    above = above && (b - a).cross(p - a).dot(normal) > 0;
  }
  return above ? std::abs(normal.dot(p - t[0])) : border;
}

Vector3d place(const Way& way, double t) {
  return {at(way.from[0], way.to[0], t), at(way.from[1], way.to[1], t), at(way.from[2], way.to[2], t)};
}

// At a meeting, the distance at the reported time is zero. Otherwise sampled distances stay away from zero, except in
// near misses: a sample is at most half an interval from the closest time.
TEST(Meeting, OfRandomMotionsAgreesWithSampledDistances) {
  test::Random random;
  int met = 0, tried = 0;
  for (; tried < test::tries(3000); ++tried) {
    std::array<Way, 4> w;
    for (Way& way : w) way = {test::random_point(random), test::random_point(random)};
    const auto sampled = [&](double t) {
      return distance(place(w[0], t), std::array{place(w[1], t), place(w[2], t), place(w[3], t)});
    };
    const auto meeting = vertex_meets_triangle(w[0], {w[1], w[2], w[3]});
    met += static_cast<int>(meeting.has_value());
    if (meeting) {
      ASSERT_LT(sampled(meeting->time), 1e-9) << tried;
      ASSERT_FALSE(meeting->touch);
    } else {
      ASSERT_GT(least(sampled), 1e-7) << tried;
    }
  }
  EXPECT_GT(met, tried / 20);
}

double sign_product(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& d) {
  return (b - a).cross(c - a).dot(d - a);
}

// An edge passes another each time it changes sides, so the parity of meetings follows from start and end alone. For
// all features of two tetrahedra: separated at the start and overlapping at the end, they must have met.
TEST(Meeting, OfTetrahedraIsFoundWheneverTheyOverlapAtTheEnd) {
  test::Random random;
  constexpr std::array<std::array<int, 3>, 4> faces{{{0, 1, 2}, {0, 1, 3}, {0, 2, 3}, {1, 2, 3}}};
  constexpr std::array<std::array<int, 2>, 6> sides{{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};
  const auto inside = [](const Vector3d& p, const std::array<Vector3d, 4>& t) {
    const double whole = sign_product(t[0], t[1], t[2], t[3]);
    return sign_product(p, t[1], t[2], t[3]) * whole > 0 && sign_product(t[0], p, t[2], t[3]) * whole > 0 &&
           sign_product(t[0], t[1], p, t[3]) * whole > 0 && sign_product(t[0], t[1], t[2], p) * whole > 0;
  };
  int joined = 0;
  for (int i = 0; i < test::tries(4000); ++i) {
    std::array<std::array<Way, 4>, 2> body;
    std::array<std::array<Vector3d, 4>, 2> end;
    for (std::size_t k = 0; k < 2; ++k) {
      for (std::size_t v = 0; v < 4; ++v) {
        const Vector3d to = test::random_point(random);
        body[k][v] = {test::random_point(random) + Vector3d(k == 0 ? -2 : 2, 0, 0), to};
        end[k][v] = to;
      }
    }
    bool overlap = false;
    for (std::size_t k = 0; k < 2; ++k) {
      for (const Vector3d& p : end[k]) overlap = overlap || inside(p, end[1 - k]);
    }
    if (!overlap) continue;
    ++joined;
    int vertices = 0, edges = 0;
    for (std::size_t k = 0; k < 2; ++k) {
      for (const Way& vertex : body[k]) {
        for (const auto& [a, b, c] : faces) {
          vertices += static_cast<int>(
              vertex_meets_triangle(vertex, {body[1 - k].at(a), body[1 - k].at(b), body[1 - k].at(c)}).has_value());
        }
      }
    }
    for (const auto& [a, b] : sides) {
      for (const auto& [c, d] : sides) {
        edges +=
            static_cast<int>(edges_meet({body[0].at(a), body[0].at(b)}, {body[1].at(c), body[1].at(d)}).has_value());
      }
    }
    ASSERT_GT(vertices + edges, 0) << i;
  }
  EXPECT_GT(joined, test::tries(50));
}

}  // namespace
}  // namespace drape::audit
