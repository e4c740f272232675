#include "study/stability.hpp"

#include <gtest/gtest.h>

#include "study/stability_map.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/usage_error.hpp"

namespace drape {
namespace {

/// Makes a study with distinct invented results; measuring it would take minutes.
StabilityStudy invented() {
  StabilityStudy study = plan_stability({.per_decade = 1, .steps = 20});
  double number = 0.1;
  for (StabilityMap& map : study.maps) {
    for (std::size_t i = 0; i < map.cells.size(); ++i) {
      const auto outcome = static_cast<StabilityOutcome>(i % 4);
      map.cells[i] = {.step = map.steps[i % map.steps.size()],
                      .stiffness = map.stiffnesses[i / map.steps.size()],
                      .outcome = outcome,
                      .energy_error = outcome == StabilityOutcome::blown_up ? INFINITY : number,
                      .not_converged = static_cast<int>(i)};
      number += 0.1;
    }
  }
  for (StabilityLimit& border : study.borders) border.predicted = border.measured = number += 0.1;
  for (EnergyCurve& curve : study.energies) {
    for (int i = 0; i < 3; ++i) {
      curve.times.push_back(0.1 * i);
      curve.energies.push_back(-(number += 0.1));
    }
  }
  return study;
}

class StabilityRuns : public test::InScratchFolder {
 protected:
  std::filesystem::path write(const StabilityStudy& study, const Shard& shard) {
    const std::string name = std::to_string(shard.number) + ".csv";
    put(path(name), stability_runs(study, shard));
    return path(name);
  }
};

TEST_F(StabilityRuns, OfShardsAreThoseOfTheWhole) {
  const StabilityStudy whole = invented();
  std::vector<std::filesystem::path> files;
  for (std::size_t k = 1; k <= 3; ++k) files.push_back(write(whole, {k, 3}));
  const MergedStability merged = merge_stability(files);
  EXPECT_TRUE(merged.missing.empty());
  ASSERT_EQ(merged.study.maps.size(), whole.maps.size());
  for (std::size_t i = 0; i < whole.maps.size(); ++i) EXPECT_EQ(map_csv(merged.study.maps[i]), map_csv(whole.maps[i]));
  ASSERT_EQ(merged.study.borders.size(), whole.borders.size());
  for (std::size_t i = 0; i < whole.borders.size(); ++i) {
    EXPECT_EQ(merged.study.borders[i].measured, whole.borders[i].measured);
  }
  for (std::size_t i = 0; i < whole.energies.size(); ++i) {
    EXPECT_EQ(merged.study.energies[i].times, whole.energies[i].times);
    EXPECT_EQ(merged.study.energies[i].energies, whole.energies[i].energies);
  }
}

TEST_F(StabilityRuns, ThatAreNotThereAreMissed) {
  const MergedStability merged = merge_stability({write(invented(), {2, 3})});
  ASSERT_EQ(merged.missing.size(), 2U);
  EXPECT_EQ(merged.missing[0].text(), "1/3");
  EXPECT_EQ(merged.missing[1].text(), "3/3");
}

TEST_F(StabilityRuns, OfAnotherStudyAreRefused) {
  StabilityStudy other = plan_stability({.per_decade = 1, .steps = 30});
  const std::vector<std::filesystem::path> files{write(invented(), {1, 2}), write(other, {2, 2})};
  EXPECT_NE(test::usage_error([&] { merge_stability(files); }).find("are not of one study"), std::string::npos);
  put(path("3.csv"), "scene,kind\n");
  EXPECT_NE(test::usage_error([&] { merge_stability({path("3.csv")}); }).find("3.csv:1: expected the runs of a study"),
            std::string::npos);
}

// Independent of other measurements in the same shard.
TEST(StabilityParts, HaveTheSameBitsInAnyShard) {
  const StabilityDetail detail{.per_decade = 1, .steps = 20};
  StabilityStudy together = plan_stability(detail), alone = plan_stability(detail);
  const std::stop_source never;
  Progress progress;
  EXPECT_TRUE(measure_stability(together, {30, 31, 32, 40}, never.get_token(), progress));
  EXPECT_TRUE(measure_stability(alone, {32}, never.get_token(), progress));
  EXPECT_EQ(together.maps.front().cells.at(32).energy_error, alone.maps.front().cells.at(32).energy_error);
  EXPECT_NE(alone.maps.front().cells.at(32).energy_error, 0);
  EXPECT_EQ(alone.maps.front().cells.at(31).step, 0) << "it was not asked for";
}

}  // namespace
}  // namespace drape
