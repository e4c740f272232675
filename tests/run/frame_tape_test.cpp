#include "run/frame_source.hpp"

#include <gtest/gtest.h>

namespace drape {
namespace {

Frame frame_of(int index, bool moving) {
  Frame frame{.index = index, .time = 0.1 * index, .positions = Vertices::Random(7, 3), .colliders = {}};
  frame.colliders = {SphereShape{{1, 2, 0.1 * index}, 0.5, 0.6}};
  if (moving) {
    frame.velocities = Vertices::Random(7, 3);
    frame.energies = Energies{.kinetic = 1.0 / index, .gravity = 2, .elastic = 3};
  }
  return frame;
}

// A tape returns its frames any number of times, wherever they are stored, in memory or on disk.
TEST(FrameTape, GivesBackTheFramesBitByBit) {
  for (const bool moving : {false, true}) {
    const std::size_t bytes = std::size_t{moving ? 2U : 1U} * 7 * 3 * sizeof(double);
    for (const std::size_t memory : {std::size_t{0}, 3 * bytes, 3 * bytes + 1, 100 * bytes}) {
      FrameTape tape(memory);
      std::vector<Frame> written;
      for (int k = 1; k < 9; ++k) tape.add(written.emplace_back(frame_of(k, moving)));
      EXPECT_EQ(tape.count(), 8);
      for (int pass = 0; pass < 3; ++pass) {
        std::size_t k = 0;
        tape.for_each([&](const Frame& frame) {
          const Frame& expected = written.at(k++);
          EXPECT_EQ(frame.index, expected.index);
          EXPECT_EQ(frame.time, expected.time);
          EXPECT_EQ(frame.positions, expected.positions);
          EXPECT_EQ(frame.velocities.rows(), moving ? 7 : 0);
          EXPECT_TRUE(!moving || frame.velocities == expected.velocities);
          EXPECT_EQ(frame.energies.has_value(), moving);
          EXPECT_EQ(std::get<SphereShape>(frame.colliders.at(0)).center, Eigen::Vector3d(1, 2, 0.1 * expected.index));
        });
        EXPECT_EQ(k, 8U);
      }
    }
  }
}

}  // namespace
}  // namespace drape
