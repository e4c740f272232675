#include "study/profile.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace drape {
namespace {

TEST(PowerLaw, ItsExponentIsFound) {
  std::vector<std::array<double, 2>> points;
  for (const double x : {10.0, 20.0, 50.0, 200.0}) points.push_back({x, 3 * std::pow(x, 1.7)});
  EXPECT_NEAR(fitted_exponent(points), 1.7, 1e-12);
  points.push_back({400, 0});  // has no logarithm
  EXPECT_NEAR(fitted_exponent(points), 1.7, 1e-12);
}

TEST(PowerLaw, ScatterAroundItEvensOut) {
  EXPECT_NEAR(fitted_exponent({{1, 1.1}, {10, 100 / 1.1}, {100, 10000 / 1.1}, {1000, 1000000 * 1.1}}), 2, 1e-2);
}

TEST(PowerLaw, OnePointHasNone) {
  EXPECT_TRUE(std::isnan(fitted_exponent({{2, 3}})));
  EXPECT_TRUE(std::isnan(fitted_exponent({})));
}

}  // namespace
}  // namespace drape
