#include "drape/core/rotation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <initializer_list>
#include <numbers>

namespace drape {
namespace {

void expect_shortest_turn(double angle, double azimuth) {
  const Eigen::Vector3d to(std::sin(angle) * std::cos(azimuth), std::sin(angle) * std::sin(azimuth), std::cos(angle));
  const Eigen::Quaterniond turn = rotation_from_z(3 * to);
  EXPECT_NEAR(turn.norm(), 1, 1e-15) << angle;
  EXPECT_LT((turn * Eigen::Vector3d::UnitZ() - to).norm(), 1e-15) << angle;
  EXPECT_NEAR(turn.angularDistance(Eigen::Quaterniond::Identity()), angle, 1e-7) << azimuth;
}

TEST(RotationFromZ, TurnsItTheShortestWay) {
  for (const double angle : {0.0, 1e-9, 0.3, 1.5, std::numbers::pi / 2, 3.0, 3.14159, std::numbers::pi - 1e-9}) {
    for (const double azimuth : {0.0, 1.0, 3.0, -2.0}) expect_shortest_turn(angle, azimuth);
  }
}

TEST(RotationFromZ, TurnsItUpsideDownAboutX) {
  const Eigen::Quaterniond turn = rotation_from_z({0, 0, -2});
  EXPECT_EQ(turn * Eigen::Vector3d::UnitZ(), Eigen::Vector3d(0, 0, -1));
  EXPECT_EQ(turn * Eigen::Vector3d::UnitX(), Eigen::Vector3d(1, 0, 0));
}

}  // namespace
}  // namespace drape
