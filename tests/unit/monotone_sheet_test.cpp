#include "sim/collision/monotone_sheet.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>

#include <cmath>

#include "drape/sim/mesh.hpp"
#include "sim/collision/candidates.hpp"
#include "tests/support/random.hpp"
#include "tests/support/setups.hpp"

namespace drape {
namespace {

using Points = std::vector<Point>;

constexpr int cells = 8;
constexpr double width = 2, thickness = 0.05;

Cloth sheet() { return test::cloth_of(make_grid(cells, cells), 1, 180, {}); }

Points points_of(const Cloth& cloth) {
  Points points;
  for (int v = 0; v < cloth.vertex_count(); ++v) points.emplace_back(cloth.rest.row(v).transpose());
  return points;
}

bool stays_apart(const Cloth& cloth, const Points& from, const Points& to) {
  MonotoneSheet sheet(cloth, thickness);
  sheet.begin(from);
  return sheet.stays_apart(to);
}

/// Returns the least distance of two features without a common vertex at ten moments of the step.
double least_distance(const Cloth& cloth, const Points& from, const Points& to) {
  double least = HUGE_VAL;
  CollisionCandidates candidates(cloth);
  for (int k = 0; k <= 10; ++k) {
    Points x = from;
    for (std::size_t i = 0; i < x.size(); ++i) x[i] += 0.1 * k * (to[i] - from[i]);
    candidates.find(x, x, 2 * thickness);
    for (const FeaturePair& pair : candidates.pairs()) {
      least = std::min(least, std::sqrt(nearest(pair.feature, gather(x, pair.vertices)).squared));
    }
  }
  return least;
}

TEST(MonotoneSheet, KnowsAFlatSheetAndARigidMotion) {
  const Cloth cloth = sheet();
  const Points flat = points_of(cloth);
  Points moved;
  const Eigen::AngleAxisd turn(0.3, Eigen::Vector3d(1, 2, 3).normalized());
  for (const Point& p : flat) moved.emplace_back(turn * p + Point(5, -3, 2));
  EXPECT_TRUE(stays_apart(cloth, flat, flat));
  EXPECT_TRUE(stays_apart(cloth, flat, moved));
}

TEST(MonotoneSheet, DoesNotClearAFoldOrASheetThatShrinks) {
  const Cloth cloth = sheet();
  const Points flat = points_of(cloth);
  Points folded = flat, small = flat;
  for (Point& p : folded) {
    if (p.x() > 0) p = Point(-p.x(), p.y(), 0.01);
  }
  for (Point& p : small) p *= 0.1;
  EXPECT_FALSE(stays_apart(cloth, flat, folded));
  EXPECT_FALSE(stays_apart(cloth, folded, flat));
  EXPECT_FALSE(stays_apart(cloth, flat, small));
}

TEST(MonotoneSheet, ClearsNothingThatIsNotFlatAndConvex) {
  Cloth bent = sheet(), notched = sheet();
  for (Eigen::Index i = 0; i < bent.rest.rows(); ++i) bent.rest(i, 2) = 0.1 * std::pow(bent.rest(i, 0), 2);
  std::erase_if(notched.triangles, [&](const Triangle& t) {
    return std::ranges::all_of(t,
                               [&](int v) { return notched.rest(v, 0) > 0.4 && std::abs(notched.rest(v, 1)) < 0.3; });
  });
  ASSERT_LT(notched.triangles.size(), sheet().triangles.size());
  EXPECT_FALSE(stays_apart(bent, points_of(bent), points_of(bent)));
  EXPECT_FALSE(stays_apart(notched, points_of(notched), points_of(notched)));
}

// Whatever it clears has no features within the thickness; and it clears many of the sheets that have none.
TEST(MonotoneSheet, ClearsOnlyStepsInWhichNothingComesNear) {
  const Cloth cloth = sheet();
  const Points flat = points_of(cloth);
  test::Random random(7);
  int cleared = 0, apart = 0;
  for (int k = 0; k < test::tries(300); ++k) {
    const double size = random.between(0, 0.3);
    const auto shaken = [&](double amount) {
      Points x = flat;
      const double bend = random.between(-2, 2);
      for (Point& p : x) {
        p = Point(std::sin(bend * p.x()) / bend, p.y(), (1 - std::cos(bend * p.x())) / bend);
        for (int axis = 0; axis < 3; ++axis) p[axis] += amount * random.between(-1, 1) * width / cells;
      }
      return x;
    };
    const Points from = shaken(size), to = shaken(size);
    const bool is_apart = least_distance(cloth, from, to) > thickness;
    apart += is_apart ? 1 : 0;
    if (!stays_apart(cloth, from, to)) continue;
    ++cleared;
    EXPECT_TRUE(is_apart) << k;
  }
  EXPECT_GT(cleared, test::tries(30));
  EXPECT_LT(cleared, apart);
}

// One object over many steps clears whatever one of its own for each step clears, and nothing else.
TEST(MonotoneSheet, ClearsNoLessInAStepThatContinuesTheLast) {
  const Cloth cloth = sheet();
  const Points flat = points_of(cloth);
  test::Random random(11);
  MonotoneSheet kept(cloth, thickness);
  int cleared = 0;
  Points from = flat;
  for (int k = 0; k < 300; ++k) {
    if (k % 30 == 0) from = flat;  // a step that begins elsewhere
    const Eigen::AngleAxisd turn(0.2, Eigen::Vector3d(0.1, 1, 0.2).normalized());
    Points to;
    for (const Point& p : from) {
      to.emplace_back(turn * p);
      for (int axis = 0; axis < 3; ++axis) to.back()[axis] += 0.05 * random.between(-1, 1) * width / cells;
    }
    kept.begin(from);
    const bool clears = kept.stays_apart(to);
    EXPECT_GE(clears, stays_apart(cloth, from, to)) << k;
    if (clears) {
      ++cleared;
      EXPECT_GT(least_distance(cloth, from, to), thickness) << k;
    }
    from = to;
  }
  EXPECT_GT(cleared, 100);
}

}  // namespace
}  // namespace drape
