#include "check/golden_motion.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <stdexcept>

#include "tests/support/motion_bytes.hpp"
#include "tests/support/sample_golden.hpp"

namespace drape::motion_file {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();

Golden sample() { return test::sample_golden(30, 25, 10, {0, 7, 9}); }

/// Returns a golden as known before its motion is read.
Golden described(Golden golden) {
  golden.windows.clear();
  for (GoldenFrame& frame : golden.frames) frame.x.resize(0, 3);
  return golden;
}

Golden unpacked(std::string_view bytes, const Golden& of) {
  Golden golden = described(of);
  unpack_motion(bytes, golden);
  return golden;
}

/// Returns the error of unpack_motion(); empty if it accepts the bytes.
std::string motion_refusal(std::string_view bytes, const Golden& of) {
  try {
    unpacked(bytes, of);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return {};
}

void expect_same_bits(const Vertices& a, const Vertices& b) {
  ASSERT_EQ(a.rows(), b.rows());
  EXPECT_EQ(std::memcmp(a.data(), b.data(), sizeof(double) * static_cast<std::size_t>(a.size())), 0);
}

void expect_same_motion(const Golden& a, const Golden& b) {
  ASSERT_EQ(a.windows.size(), b.windows.size());
  for (std::size_t i = 0; i < a.windows.size(); ++i) {
    const GoldenWindow &p = a.windows[i], &q = b.windows[i];
    EXPECT_EQ(p.start.step, q.start.step);
    expect_same_bits(p.start.x, q.start.x);
    expect_same_bits(p.start.v, q.start.v);
    expect_same_bits(p.middle, q.middle);
    EXPECT_EQ(p.energies.elastic, q.energies.elastic);
    ASSERT_EQ(p.steps.size(), q.steps.size());
    for (std::size_t k = 0; k < p.steps.size(); ++k) {
      EXPECT_EQ(p.steps[k].hash, q.steps[k].hash);
      EXPECT_EQ(p.steps[k].bodies, q.steps[k].bodies);
      EXPECT_EQ(p.steps[k].groups, q.steps[k].groups);
    }
  }
  ASSERT_EQ(a.frames.size(), b.frames.size());
  for (std::size_t i = 0; i < a.frames.size(); ++i) expect_same_bits(a.frames[i].x, b.frames[i].x);
}

TEST(MotionFile, LosesNothing) {
  Golden golden = sample();
  ASSERT_EQ(golden.windows.size(), 4u);  // steps 0 to 10, to 20, to 25, and the end
  golden.windows[0].start.x(3, 1) = -0.0;
  golden.windows[1].start.x(4, 1) = 1e300;  // too far away to be a multiple of the quantum
  golden.windows[1].steps[3].bodies.resize(4);
  expect_same_motion(unpacked(pack_motion(golden), golden), golden);
  golden.quanta.position = golden.quanta.velocity = 0;  // exact
  expect_same_motion(unpacked(pack_motion(golden), golden), golden);
}

TEST(MotionFile, KeepsAMotionWithoutSteps) {
  const Golden golden = test::sample_golden(5, 0, 10, {0});
  ASSERT_EQ(golden.windows.size(), 2u);
  expect_same_motion(unpacked(pack_motion(golden), golden), golden);
}

TEST(MotionFile, TakesAboutThirtyBitsForWhatIsRounded) {
  Golden golden = test::sample_golden(441, 1, 1, {});
  for (GoldenWindow& window : golden.windows) {
    window.start.x = rounded(Vertices::Random(441, 3), golden.quanta.position);
    window.start.v = rounded(Vertices::Random(441, 3), golden.quanta.velocity);
  }
  const std::size_t rounded_size = pack_motion(golden).size();
  EXPECT_LT(8 * rounded_size, 36u * 4 * 441 * 3);  // four fields; prediction makes random numbers larger
  for (GoldenWindow& window : golden.windows) window.start = {Vertices::Random(441, 3), Vertices::Random(441, 3), 0};
  EXPECT_GT(pack_motion(golden).size(), 3 * rounded_size / 2);
}

TEST(MotionFile, RefusesWhatIsNotFinite) {
  for (const double value : {nan, infinity, -infinity}) {
    Golden bad = sample();
    bad.windows[1].start.v(1, 1) = value;
    EXPECT_EQ(motion_refusal(pack_motion(bad), bad), "contains a number that is not finite") << value;
    bad = sample();
    bad.windows[1].energies.kinetic = value;
    EXPECT_EQ(motion_refusal(pack_motion(bad), bad), "contains a number that is not finite") << value;
    bad = sample();
    bad.frames[1].x(1, 1) = value;
    EXPECT_EQ(motion_refusal(pack_motion(bad), bad), "contains a number that is not finite") << value;
  }
}

TEST(MotionFile, RefusesTheMotionOfAnotherGolden) {
  const Golden golden = sample();
  const std::string bytes = pack_motion(golden);
  const auto refusal = [&](auto change) {
    Golden other = golden;
    change(other);
    return motion_refusal(bytes, other);
  };
  EXPECT_EQ(refusal([](Golden&) {}), "");
  EXPECT_NE(refusal([](Golden& g) { g.vertex_count = 31; }), "");
  EXPECT_NE(refusal([](Golden& g) { g.vertex_count = 2'000'000'000; }), "");
  EXPECT_NE(refusal([](Golden& g) { g.step_count = 26; }), "");
  EXPECT_NE(refusal([](Golden& g) { g.step_count = 1'000'000'000; }), "");
  EXPECT_NE(refusal([](Golden& g) { g.window_steps = 11; }), "");
  EXPECT_NE(refusal([](Golden& g) { g.body_count = 6; }), "");
  EXPECT_NE(refusal([](Golden& g) { g.frames.pop_back(); }), "");
  EXPECT_NE(refusal([](Golden& g) { g.frames.push_back({}); }), "");
  EXPECT_NE(refusal([](Golden& g) { g.quanta.position = 0; }), "");
}

TEST(MotionFile, UnpacksNoMoreThanItMay) {
  const Golden golden = test::sample_golden(1, 2, 1, {0});
  EXPECT_EQ(motion_refusal(test::motion_bytes(Words(100'000)), golden), "holds more than its manifest allows");
  EXPECT_EQ(motion_refusal(test::motion_bytes(Words(10)), golden), "is truncated");
}

TEST(MotionFile, RefusesEveryDamage) {
  const Golden golden = test::sample_golden(12, 3, 2, {0});
  const std::string good = pack_motion(golden);
  EXPECT_NE(motion_refusal("", golden), "");
  EXPECT_NE(motion_refusal("drape motion 2\n99999999999999\n", golden), "");
  EXPECT_EQ(motion_refusal(good + "x", golden), "is damaged");
  std::size_t refused = 0;
  for (std::size_t i = 0; i < good.size(); ++i) {
    EXPECT_NE(motion_refusal(good.substr(0, i), golden), "") << "cut off at " << i;
    std::string bad = good;
    bad[i] = static_cast<char>(bad[i] ^ 0x10);
    try {
      // A bit unused by the compression may flip: then the numbers are the same.
      EXPECT_EQ(pack_motion(unpacked(bad, golden)), good) << "byte " << i;
    } catch (const std::invalid_argument&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, good.size() * 95 / 100);
}

}  // namespace
}  // namespace drape::motion_file
