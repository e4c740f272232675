#include "run/resources.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/machine.hpp"
#include "tests/support/setups.hpp"

namespace drape::test {
namespace {

SimulationSettings cloth_of_cells(int cells) { return {.cloth = cloth_of(make_grid(cells, cells), 1, 180, {})}; }

TEST(ThreadCount, IsWhatIsAskedFor) {
  const SimulationSettings settings = with_threads(cloth_of_cells(3), 7, true);
  EXPECT_EQ(settings.threads, 7);
  EXPECT_FALSE(settings.spare_threads);
}

TEST(ThreadCount, OfAClothThatIsNotDividedIsOne) { EXPECT_EQ(with_threads(cloth_of_cells(89), 0, false).threads, 1); }

TEST(ThreadCount, LeavesAProcessorForDrawing) {
  const SimulationSettings alone = with_threads(cloth_of_cells(200), 0, false),
                           drawn = with_threads(cloth_of_cells(200), 0, true);
  EXPECT_TRUE(alone.spare_threads);
  EXPECT_LE(alone.threads, processors_left());
  EXPECT_LE(drawn.threads, std::max(1, processors_left() - 1));
  EXPECT_GE(drawn.threads, 1);
}

}  // namespace
}  // namespace drape::test
