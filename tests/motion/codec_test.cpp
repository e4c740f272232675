#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "motion/blocks.hpp"
#include "motion/encoding.hpp"
#include "tests/support/setups.hpp"

namespace drape::test {
namespace {

constexpr double h = 0.01;

/// Returns states at steps 0, `every`, 2·every, … of moving vertices.
std::vector<State> wavering(Eigen::Index vertices, std::int64_t every, int count) {
  const Vertices start = random_vertices(vertices, 1), way = random_vertices(vertices, 2),
                 turn = random_vertices(vertices, 3);
  std::vector<State> states;
  for (int k = 0; k < count; ++k) {
    const double t = static_cast<double>(k * every) * h;
    states.push_back(
        {.x = start + way * std::sin(t) + turn * t * t, .v = way * std::cos(t) + 2 * t * turn, .step = k * every});
  }
  return states;
}

void expect_back(const std::vector<State>& states) {
  StateCodec writer(states[0].x.rows(), h), reader(states[0].x.rows(), h);
  for (const State& state : states) {
    const State& read = reader.decode(writer.encode(state));
    EXPECT_EQ(read.step, state.step);
    EXPECT_TRUE(same_bits(read.x, state.x)) << state.step;
    EXPECT_TRUE(same_bits(read.v, state.v)) << state.step;
  }
}

TEST(StateCodec, GivesEveryBitBack) {
  expect_back(wavering(50, 1, 12));
  expect_back(wavering(1, 1, 12));
  expect_back(wavering(50, 7, 12));
}

TEST(StateCodec, GivesExtremeNumbersBack) {
  using Limits = std::numeric_limits<double>;
  std::vector<State> states = wavering(2, 1, 8);
  for (State& state : states) {
    state.x.row(0) << -0.0, Limits::denorm_min(), Limits::max();
    state.v.row(0) << Limits::lowest(), Limits::max(), -0.0;
    state.x.row(1) *= state.step % 2 == 0 ? 1e300 : -1e-300;
  }
  expect_back(states);
}

TEST(StateCodec, FindsASteadyMotionForetold) {
  std::vector<State> states = wavering(500, 1, 6);
  for (State& state : states) {
    // Exact in binary: the prediction leaves no residual.
    state.x = states[0].x.array().round() + 0.25 * static_cast<double>(state.step);
    state.v.setConstant(0.25);
  }
  StateCodec codec(500, h);
  std::size_t first = 0, last = 0;
  for (const State& state : states) {
    last = codec.encode(state).size();
    if (state.step == 0) first = last;
  }
  EXPECT_LT(last, 200u);
  EXPECT_GT(first, 200u);
}

/// Euler's methods move with the velocity at the step's end, so positions determine velocities up to rounding.
TEST(StateCodec, KnowsEulersVelocitiesFromTheWay) {
  std::vector<State> states = wavering(500, 1, 6);
  for (std::size_t k = 1; k < states.size(); ++k) {
    states[k].v = random_vertices(500, static_cast<int>(10 + k));
    states[k].x = states[k - 1].x + h * states[k].v;
  }
  expect_back(states);
  StateCodec codec(500, h);
  std::size_t last = 0;
  for (const State& state : states) last = codec.encode(state).size();
  // Positions in the 48 bytes per vertex are noise, and velocities only the rounding of x + h·v.
  EXPECT_LT(last, 500u * 38);
}

TEST(StateCodec, RefusesWhatIsNoState) {
  const std::vector<State> states = wavering(3, 1, 2);
  StateCodec writer(3, h);
  const std::string first = writer.encode(states[0]), second = writer.encode(states[1]);
  StateCodec reader(3, h);
  EXPECT_THROW(reader.decode(second), std::invalid_argument) << "predicted from a state that is missing";
  EXPECT_THROW(reader.decode(first.substr(0, first.size() - 1)), std::invalid_argument);
  EXPECT_THROW(reader.decode(first + "x"), std::invalid_argument);
  EXPECT_THROW(reader.decode(""), std::invalid_argument);
  EXPECT_THROW(StateCodec(4, h).decode(first), std::invalid_argument) << "of another cloth";
  reader.decode(first);
  EXPECT_THROW(reader.decode(first), std::invalid_argument) << "the same step again";
}

TEST(StateCodec, RefusesNumbersThatAreNotFinite) {
  StateCodec reader(1, h);
  std::vector<std::uint64_t> words(6, 0);
  words[4] = std::uint64_t{0x7ff0000000000000} << 1;  // infinity, as a difference to zero
  const std::string bytes = ByteWriter().whole(0).whole(0).bytes(pack_planes(words)).text();
  EXPECT_THROW(reader.decode(bytes), std::invalid_argument);
}

TEST(Packing, GivesBytesBack) {
  for (const std::size_t size : {std::size_t{0}, std::size_t{1}, std::size_t{1000}, std::size_t{3000000}}) {
    std::string bytes(size, 'a');
    for (std::size_t i = 0; i < size; i += 7) bytes[i] = static_cast<char>(i * i);
    EXPECT_EQ(unpack(pack(bytes)), bytes);
  }
}

TEST(Packing, MakesNothingLargerThanTheBytesCanBe) {
  // Claims a size of 2⁶³ bytes.
  EXPECT_THROW(unpack(ByteWriter().whole(std::uint64_t{1} << 63).bytes("abc").text()), std::invalid_argument);
  const std::string packed = pack("abc");
  EXPECT_THROW(unpack(ByteWriter().whole(4).bytes(packed.substr(8)).text()), std::invalid_argument);
  EXPECT_THROW(unpack(ByteWriter().whole(2).bytes(packed.substr(8)).text()), std::invalid_argument);
}

}  // namespace
}  // namespace drape::test
