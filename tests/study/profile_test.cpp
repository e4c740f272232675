#include "study/profile.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/study/invented_study.hpp"

namespace drape {
namespace {

// By hand: two solvers, three problems. Both solve the first, in 2 and 4 s; only the second solver solves the second;
// neither solves the third.
TEST(PerformanceProfile, OfATableByHand) {
  const double never = INFINITY;
  const auto curves = performance_profile({{"p", "q", "r"}, {"a", "b"}, {{2, never, never}, {4, 3, never}}});
  ASSERT_EQ(curves.size(), 2U);
  EXPECT_EQ(curves[0].ratios, (std::vector<double>{1}));
  EXPECT_EQ(curves[1].ratios, (std::vector<double>{1, 2}));
  EXPECT_DOUBLE_EQ(curves[0].share(1), 1.0 / 3);
  EXPECT_DOUBLE_EQ(curves[0].share(1e9), 1.0 / 3);
  EXPECT_DOUBLE_EQ(curves[1].share(0.99), 0);
  EXPECT_DOUBLE_EQ(curves[1].share(1), 1.0 / 3);
  EXPECT_DOUBLE_EQ(curves[1].share(1.99), 1.0 / 3);
  EXPECT_DOUBLE_EQ(curves[1].share(2), 2.0 / 3);
  EXPECT_DOUBLE_EQ(curves[1].share(never), 2.0 / 3);
}

TEST(PerformanceProfile, TakesTheCheapestRunBelowTheTarget) {
  std::vector<std::string> notes;
  const ProfileTimes times = profile_times({test::invented_scene("a"), test::invented_scene("b")}, notes);
  EXPECT_EQ(times.problems,
            (std::vector<std::string>{"a.toml, 1 mm", "a.toml, 0.1 mm", "b.toml, 1 mm", "b.toml, 0.1 mm"}));
  EXPECT_EQ(times.solvers, (std::vector<std::string>{"implicit", "verlet"}));
  // For the invented runs: Newton's with h = 0.01 s reaches 0.5 mm, as does an accuracy of 1e-3 at a higher cost; only
  // that of 1e-4 is below 0.1 mm. Verlet fails with its cheap setting.
  EXPECT_DOUBLE_EQ(times.times[0][0], 20);
  EXPECT_DOUBLE_EQ(times.times[0][1], 90);
  EXPECT_DOUBLE_EQ(times.times[1][0], 5);
  EXPECT_TRUE(std::isinf(times.times[1][1]));
  EXPECT_TRUE(notes.empty());
}

TEST(PerformanceProfile, LeavesOutWhatIsNotKnown) {
  SceneAccuracy scene = test::invented_scene("a");
  scene.step_gained = {5e-4};
  std::vector<std::string> notes;
  EXPECT_EQ(profile_times({scene}, notes).problems, std::vector<std::string>{"a.toml, 1 mm"});
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_NE(notes[0].find("a.toml, 0.1 mm is no problem here"), std::string::npos) << notes[0];
}

}  // namespace
}  // namespace drape
