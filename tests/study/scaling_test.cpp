#include "study/scaling.hpp"

#include <gtest/gtest.h>

#include "drape/sim/simulation.hpp"
#include "study/measure.hpp"

namespace drape {
namespace {

SimulationSettings small_cloth() {
  return StudyCase{"", "scenes/homework/4.toml", {"cloth.mesh={grid=[6,6]}"}, 5}.load().simulation;
}

TEST(KernelClock, MeasuresWhatAMethodDoesAndChangesNoBits) {
  const Kernels& plain = kernels();
  Simulation unwatched(small_cloth()), watched(small_cloth());
  for (int i = 0; i < 5; ++i) unwatched.step();
  {
    const KernelClock clock;
    EXPECT_NE(&kernels(), &plain);
    for (int i = 0; i < 5; ++i) watched.step();
    EXPECT_GT(clock.seconds(KernelPart::local), 0);
    EXPECT_GT(clock.seconds(KernelPart::global), 0);
    EXPECT_EQ(clock.seconds(KernelPart::assembly), 0);  // liu13 assembles no matrix in a step
    EXPECT_EQ(clock.seconds(KernelPart::product), 0);
  }
  EXPECT_EQ(&kernels(), &plain);
  EXPECT_EQ(watched.state().x, unwatched.state().x);
}

TEST(Scaling, MeasuresEveryMethodOnEveryGrid) {
  Progress progress;
  const auto study = study_scaling({.grids = {10, 20}, .runs = 2}, {}, progress);
  ASSERT_TRUE(study);
  EXPECT_TRUE(study->notes.empty());
  ASSERT_EQ(study->points.size(), 12U);
  for (std::size_t i = 0; i < study->points.size(); ++i) {
    const ScalingPoint& p = study->points[i];
    SCOPED_TRACE(p.method);
    EXPECT_EQ(p.cells, i % 2 == 0 ? 10 : 20);
    EXPECT_EQ(p.vertices, (p.cells + 1) * (p.cells + 1));
    if (p.cells == 20) {
      EXPECT_GT(p.memory, study->points[i - 1].memory);
    }
    const TimeShares& s = p.shares;
    EXPECT_NEAR(s.local + s.assembly + s.product + s.global + s.vectors + s.contact + s.rest, 1, 1e-9);
    EXPECT_GT(s.local, 0);
    EXPECT_GT(s.contact, 0);
    const bool explicit_method = p.method == "semi-implicit";
    EXPECT_EQ(explicit_method, p.factor == 0);
    EXPECT_EQ(explicit_method, p.iterations == 0);
    EXPECT_EQ(s.product > 0, p.method == "implicit");
    if (p.method == "liu13") {
      EXPECT_GT(s.global, s.vectors);
    }
  }
  const std::string text = to_text(scaling_report(*study));
  EXPECT_NE(text.find("20×20"), std::string::npos);
}

}  // namespace
}  // namespace drape
