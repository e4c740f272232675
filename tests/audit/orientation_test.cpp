// Signs compared with 128-bit integers, for volumes that are zero or minimal.

#include "audit/predicates.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <stdexcept>

#include "tests/audit/exact_roots.hpp"
#include "tests/support/random.hpp"

namespace drape::audit {
namespace {

using Whole = std::array<std::int64_t, 3>;

int sign_of_integer(Integer value) { return static_cast<int>(value > 0) - static_cast<int>(value < 0); }

int integer_orientation(const std::array<Whole, 4>& p) {
  const auto d = [&](std::size_t i, std::size_t axis) { return static_cast<Integer>(p[i][axis]) - p[0][axis]; };
  return sign_of_integer((d(1, 0) * d(2, 1) - d(1, 1) * d(2, 0)) * d(3, 2) +
                         (d(1, 1) * d(2, 2) - d(1, 2) * d(2, 1)) * d(3, 0) +
                         (d(1, 2) * d(2, 0) - d(1, 0) * d(2, 2)) * d(3, 1));
}

Eigen::Vector3d point(const Whole& p, double scale) {
  return scale * Eigen::Vector3d(static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2]));
}

Whole random_whole(test::Random& random, double size) {
  Whole p;
  for (std::int64_t& c : p) c = static_cast<std::int64_t>(random.between(-size, size));
  return p;
}

TEST(Orientation, IsThatOfIntegersOnASmallGrid) {
  test::Random random;
  std::map<int, int> seen;
  for (int i = 0; i < test::tries(20000); ++i) {
    std::array<Whole, 4> p;
    for (Whole& q : p) q = random_whole(random, 3.99);
    const int expected = integer_orientation(p);
    ++seen[expected];
    ASSERT_EQ(orientation(point(p[0], 0.1), point(p[1], 0.1), point(p[2], 0.1), point(p[3], 0.1)) * expected * expected,
              expected);
    ASSERT_EQ(orientation(point(p[0], 1), point(p[1], 1), point(p[2], 1), point(p[3], 1)), expected);
  }
  for (const int sign : {-1, 0, 1}) EXPECT_GT(seen[sign], test::tries(100));
}

// Three points of size 2³⁶ and a fourth in their plane or one unit beside it: the sign needs volumes of 2¹¹⁰ exact to a
// unit.
TEST(Orientation, IsThatOfIntegersInAPlane) {
  test::Random random;
  std::map<int, int> seen;
  for (int i = 0; i < test::tries(20000); ++i) {
    std::array<Whole, 4> p;
    for (std::size_t k = 0; k < 3; ++k) p[k] = random_whole(random, 0x1p36);
    const std::int64_t m = random.below(7) - 3, n = random.below(7) - 3;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      p[3][axis] = p[0][axis] + m * (p[1][axis] - p[0][axis]) + n * (p[2][axis] - p[0][axis]);
    }
    if (i % 2 == 0) p[3].at(static_cast<std::size_t>(random.below(3))) += random.below(3) - 1;
    const int expected = integer_orientation(p);
    ++seen[expected];
    for (const double scale : {1.0, 0x1p-40, 0x1p-190}) {
      ASSERT_EQ(orientation(point(p[0], scale), point(p[1], scale), point(p[2], scale), point(p[3], scale)), expected);
    }
  }
  for (const int sign : {-1, 0, 1}) EXPECT_GT(seen[sign], test::tries(1000));
}

TEST(Orientation, ChangesWithTheLastPlaceOfADouble) {
  const Eigen::Vector3d a(0.5, 0.5, 0.5), b(12, 12, 12), c(24, 24, 12);
  const double next = std::nextafter(0.5, 1);
  EXPECT_EQ(orientation(a, b, c, {0.5, 0.5, 24}), 0);
  EXPECT_EQ(orientation(a, b, c, {0.5, next, 24}) * orientation(a, b, c, {next, 0.5, 24}), -1);
}

// (a + b)(a − b) and a² − b², which doubles cannot hold.
TEST(Expansion, ComputesAsIntegersDo) {
  test::Random random;
  for (int i = 0; i < test::tries(5000); ++i) {
    const double a = std::floor(random.between(-0x1p52, 0x1p52)), b = std::floor(random.between(-0x1p52, 0x1p52));
    const Expansion sum = Expansion(a) + Expansion(b), difference = Expansion::difference(a, b);
    const Expansion left = sum * difference, right = Expansion(a) * Expansion(a) - Expansion(b) * Expansion(b);
    ASSERT_EQ((left - right).sign(), 0);
    ASSERT_EQ((left.half() + right.half() - left - Expansion(1)).sign(), -1);
    const auto m = static_cast<Integer>(a), n = static_cast<Integer>(b);
    ASSERT_EQ(left.sign(), sign_of_integer(m * m - n * n));
    ASSERT_DOUBLE_EQ(left.estimate(), static_cast<double>(m * m - n * n));
    const Expansion rounding = left - Expansion(left.estimate());
    ASSERT_EQ(rounding.estimate(), static_cast<double>(m * m - n * n - static_cast<Integer>(left.estimate())));
  }
}

TEST(Expansion, KeepsCoordinatesAndRoundsWhatIsTiny) {
  for (const double x : {0.0, 1.0, -0.3, 1e-44, 1e20}) EXPECT_EQ(on_exact_grid(x), x);
  EXPECT_EQ(on_exact_grid(1e-300), 0);
  EXPECT_EQ(on_exact_grid(-3.4 * exact_range::grid), -3 * exact_range::grid);
  for (const double x : {1e31, std::nan(""), -HUGE_VAL}) EXPECT_THROW(on_exact_grid(x), std::invalid_argument);
}

}  // namespace
}  // namespace drape::audit
