// Motions as functions of time: keyframes, tracks of spheres, gusts.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "drape/sim/effects/air.hpp"
#include "drape/sim/tracks.hpp"

namespace drape {
namespace {

using Eigen::Vector3d;

const std::vector<Keyframe> zigzag{{0.1, {0, 1, 5}}, {0.3, {1, 1, 4}}, {0.4, {3, -2, 6}}, {1, {4, -2, 0.1}}};

TEST(Keyframes, AreHitExactlyAtTheTimesOfSteps) {
  for (const Interpolation interpolation : {Interpolation::linear, Interpolation::smooth}) {
    const Keyframes path(zigzag, interpolation);
    for (const Keyframe& key : zigzag) EXPECT_EQ(path.at(key.time), key.value);
    // 0.3 and 0.7 are no multiples of 0.1 in binary.
    for (const double h : {0.1, 0.02, 0.001}) {
      EXPECT_EQ(path.at(std::round(0.3 / h) * h), zigzag[1].value) << h;
      EXPECT_EQ(path.at(std::round(1 / h) * h), zigzag[3].value) << h;
    }
  }
}

TEST(Keyframes, StayAtTheFirstAndTheLast) {
  const Keyframes path(zigzag, Interpolation::smooth);
  EXPECT_EQ(path.at(-5), zigzag.front().value);
  EXPECT_EQ(path.at(0), zigzag.front().value);
  EXPECT_EQ(path.at(1e9), zigzag.back().value);
  EXPECT_EQ(Keyframes({{2, {1, 2, 3}}}, Interpolation::smooth).at(7), Vector3d(1, 2, 3));
}

TEST(Keyframes, LinearIsSteady) {
  const Keyframes path(zigzag, Interpolation::linear);
  EXPECT_LT((path.at(0.2) - Vector3d(0.5, 1, 4.5)).norm(), 1e-15);
  EXPECT_LT((path.at(0.375) - Vector3d(2.5, -1.25, 5.5)).norm(), 1e-14);
}

TEST(Keyframes, SmoothHasNoJumpOfSpeedAndDoesNotOvershoot) {
  const Keyframes path(zigzag, Interpolation::smooth);
  const double e = 1e-7;
  for (const Keyframe& key : zigzag) {
    const Vector3d before = (path.at(key.time) - path.at(key.time - e)) / e;
    const Vector3d after = (path.at(key.time + e) - path.at(key.time)) / e;
    EXPECT_LT((before - after).norm(), 1e-3) << key.time;
  }
  // It starts and ends at rest, and passes the second keyframe, where x rises, without stopping.
  EXPECT_LT((path.at(0.1 + e) - path.at(0.1)).norm() / e, 1e-3);
  EXPECT_LT((path.at(1) - path.at(1 - e)).norm() / e, 1e-3);
  EXPECT_GT((path.at(0.3 + e) - path.at(0.3))[0] / e, 1);
  for (std::size_t i = 1; i < zigzag.size(); ++i) {
    const Vector3d low = zigzag[i - 1].value.cwiseMin(zigzag[i].value);
    const Vector3d high = zigzag[i - 1].value.cwiseMax(zigzag[i].value);
    for (double s = 0; s < 1; s += 0.01) {
      const Vector3d value = path.at(zigzag[i - 1].time + s * (zigzag[i].time - zigzag[i - 1].time));
      EXPECT_TRUE((value.array() >= low.array() - 1e-12).all() && (value.array() <= high.array() + 1e-12).all());
    }
  }
}

// Compared with backward differences, to their own error.
TEST(Keyframes, VelocityIsTheirSlope) {
  for (const Interpolation interpolation : {Interpolation::linear, Interpolation::smooth}) {
    const Keyframes path(zigzag, interpolation);
    const double first = zigzag.front().time, last = zigzag.back().time;
    constexpr double d = 1e-8;
    for (double time = first - 0.3; time < last + 0.3; time += 0.0317) {
      const Vector3d slope = (path.at(time) - path.at(time - d)) / d;
      EXPECT_LT((path.velocity(time) - slope).norm(), 1e-4) << "at " << time;
    }
    for (const Keyframe& key : zigzag) {
      EXPECT_LT((path.velocity(key.time) - (path.at(key.time) - path.at(key.time - d)) / d).norm(), 1e-4);
    }
    EXPECT_EQ(path.velocity(first), Vector3d::Zero());
    EXPECT_EQ(path.velocity(last + 1), Vector3d::Zero());
  }
}

TEST(Keyframes, MustBeInOrder) {
  EXPECT_THROW(Keyframes({}, Interpolation::linear), std::invalid_argument);
  EXPECT_THROW(Keyframes({{1, {0, 0, 0}}, {1, {1, 1, 1}}}, Interpolation::linear), std::invalid_argument);
}

TEST(SphereTrack, StraightOn) {
  const auto track = straight_track({{1, 2, 3}, 0.5}, {1, 0, -2});
  EXPECT_EQ(track->at(0).center, Vector3d(1, 2, 3));
  EXPECT_EQ(track->at(2).center, Vector3d(3, 2, -1));
  EXPECT_EQ(track->at(2).radius, 0.5);
}

TEST(SphereTrack, CirclesAroundAnyAxis) {
  const Orbit orbit{.center = {1, 1, 7}, .axis = {0, 0, 3}, .period = 4};
  const auto track = circling_track({{3, 1, 2}, 0.5}, orbit);
  EXPECT_LT((track->at(1).center - Vector3d(1, 3, 2)).norm(), 1e-14) << "a quarter turn, seen from the axis' tip";
  EXPECT_LT((track->at(2).center - Vector3d(-1, 1, 2)).norm(), 1e-14);
  EXPECT_EQ(track->at(4e6).center, Vector3d(3, 1, 2)) << "whole turns lead back to the bits of the start";
  const auto backwards = circling_track({{3, 1, 2}, 0.5}, {orbit.center, orbit.axis, -4});
  EXPECT_LT((backwards->at(1).center - Vector3d(1, -1, 2)).norm(), 1e-14);

  const Orbit tilted{.center = {0, 0, 0}, .axis = {1, 1, 1}, .period = 3};
  const auto turned = circling_track({{1, 0, 0}, 1}, tilted);  // a third of a turn exchanges the axes
  EXPECT_LT((turned->at(1).center - Vector3d(0, 1, 0)).norm(), 1e-14);
  EXPECT_THROW(circling_track({}, {.axis = {0, 0, 0}}), std::invalid_argument);
}

TEST(PinPhases, LoseThePinsThatAreReleased) {
  const auto phases = pin_phases({1, 4, 5, 9}, {{10, {4, 9}}, {3, {5}}, {10, {1}}});
  ASSERT_EQ(phases.size(), 3U);
  EXPECT_EQ(phases[0].pins, (std::vector{1, 4, 5, 9}));
  EXPECT_EQ(phases[1].first_step, 3);
  EXPECT_EQ(phases[1].pins, (std::vector{1, 4, 9}));
  EXPECT_EQ(phases[2].first_step, 10);
  EXPECT_TRUE(phases[2].pins.empty());
  EXPECT_EQ(pin_phases({1}, {}).size(), 1U);
}

TEST(Gusts, AreAPureFunctionOfSeedPlaceAndTime) {
  const Gusts gusts({.speed = 2, .size = 0.7, .duration = 1.3, .seed = 4}, {1, 0, 0});
  const Gusts same({.speed = 2, .size = 0.7, .duration = 1.3, .seed = 4}, {1, 0, 0});
  const Gusts other({.speed = 2, .size = 0.7, .duration = 1.3, .seed = 5}, {1, 0, 0});
  const Vector3d place(0.3, -4, 2);
  const Vector3d first = gusts.at(place, 7);
  static_cast<void>(gusts.at({9, 9, 9}, 1));
  EXPECT_EQ(gusts.at(place, 7), first);
  EXPECT_EQ(same.at(place, 7), first);
  EXPECT_GT((other.at(place, 7) - first).norm(), 1e-3);
}

TEST(Gusts, AreBoundedContinuousAndEvenOnAverage) {
  const Gusts gusts({.speed = 3, .size = 0.5, .duration = 0.5, .seed = 1}, {2, 1, 0});
  Vector3d sum = Vector3d::Zero();
  double largest = 0;
  constexpr int count = 20000;
  for (int i = 0; i < count; ++i) {
    const Vector3d place(0.17 * i, std::sin(i), -0.3 * i);
    const Vector3d value = gusts.at(place, 0.01 * i);
    sum += value;
    largest = std::max(largest, value.cwiseAbs().maxCoeff());
    EXPECT_LT((gusts.at(place + Vector3d(1e-6, 0, 0), 0.01 * i) - value).norm(), 1e-4);
    EXPECT_LT((gusts.at(place, 0.01 * i + 1e-6) - value).norm(), 1e-4);
  }
  EXPECT_LE(largest, 3);
  EXPECT_GT(largest, 1.5);
  EXPECT_LT(sum.cwiseAbs().maxCoeff() / count, 0.05);
}

TEST(Gusts, AreCarriedByTheWind) {
  const Vector3d wind(2, -1, 0.5);
  const GustValues frozen{.speed = 1, .size = 0.5, .duration = 1e9, .seed = 1};
  const Gusts gusts(frozen, wind);
  EXPECT_LT((gusts.at({1, 2, 3}, 0) - gusts.at(Vector3d(1, 2, 3) + 0.8 * wind, 0.8)).norm(), 1e-6);
}

}  // namespace
}  // namespace drape
