#include "study/motions.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "study/stability.hpp"
#include "tests/support/scene_folder.hpp"

namespace drape {
namespace {

class StudyMotions : public testing::Test {
 protected:
  /// Records a grid that falls for some steps of 10 ms.
  [[nodiscard]] StudyMotion record(int cells, int steps, const std::string& more = {}) const {
    const std::string file =
        folder_
            .write("scene.toml",
                   fmt::format("[cloth]\nmesh = {{ grid = [{0}, {0}] }}\nstiffness = 1\n[time]\nstep = 0.01\nduration "
                               "= 1\n[integrator]\nmethod = \"semi-implicit\"\n[effects.gravity]\n{1}",
                               cells, more))
            .string();
    auto motion = record_study_motion({"", file, {}, steps}, "falls", {});
    EXPECT_TRUE(motion);
    return std::move(*motion);
  }

  test::SceneFolder folder_;
};

TEST_F(StudyMotions, AreWholeAndEvenlySpacedHoweverLongTheyAre) {
  for (const int steps : {1, 7, 99, 100, 101, 250, 1000}) {
    const StudyMotion motion = record(2, steps);
    const nlohmann::json description = nlohmann::json::parse(motion.played.description);
    const int frames = motion.played.frames;
    const double between = description["seconds"];
    EXPECT_LE(frames, 100) << steps;
    EXPECT_GE(frames, std::min(steps + 1, 50)) << steps;
    EXPECT_LE((frames - 1) * between, 0.01 * steps + 1e-9) << steps;
    EXPECT_GT(frames * between, 0.01 * steps - 1e-9) << steps << ": less than a frame is missing at the end";
    // Without a support it falls: the motion's bounding box is as high as the fall.
    const double height = description["highest"][2].get<double>() - description["lowest"][2].get<double>();
    const double time = (frames - 1) * between;
    EXPECT_NEAR(height, 0.5 * 9.8 * time * (time + 0.01), 1e-3 * height + 1e-4) << steps;
  }
}

TEST_F(StudyMotions, HaveFewerFramesOfALargeCloth) {
  const StudyMotion motion = record(60, 40);
  EXPECT_LE(motion.played.frames * 61 * 61, 50'000);
  EXPECT_GE(motion.played.frames, 7);
}

TEST_F(StudyMotions, AreMadeAgainByTheirCommand) {
  const StudyMotion motion = record(2, 7);
  EXPECT_TRUE(motion.command.ends_with("scene.toml --steps 7 -o motion.html")) << motion.command;
}

TEST_F(StudyMotions, StayInSightBelowTheLimitOfStabilityAlone) {
  const std::vector<StudyMotion> motions = limit_motions();
  ASSERT_EQ(motions.size(), 2U);
  EXPECT_EQ(motions[0].played.frames, 100);
  EXPECT_LT(motions[0].played.size, 6) << "a square of 2 m that swings";
  EXPECT_LE(motions[1].played.frames, 100);
  EXPECT_GT(motions[1].played.size, 8);
}

}  // namespace
}  // namespace drape
