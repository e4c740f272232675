#include "study/stability_report.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/simulation.hpp"
#include "sim/stability.hpp"
#include "study/stability_map.hpp"

namespace drape {
namespace {

TEST(StabilityBorder, LiesWhereItIsPredicted) {
  for (const double stiffness : {1e-2, 1e3, 1e8}) {
    const StabilityBorder border = stability_border(stiffness);
    EXPECT_GE(border.measured / border.predicted, 0.98) << stiffness;
    EXPECT_LE(border.measured / border.predicted, 1.2) << stiffness;
  }
}

// The cells on both sides of the line of a map.
TEST(StabilityCell, IsStableBelowTheSafeStepAndBlownUpBeyondItsBorder) {
  for (const double stiffness : {1.0, 1e6}) {
    const double safe = safe_step(make_system(stability_cloth(Method::semi_implicit, 1, stiffness)));
    const auto at = [&](double factor) {
      return stability_cell(Method::semi_implicit, StabilityAxis::springs, factor * safe, stiffness, 1000).outcome;
    };
    EXPECT_EQ(at(0.98), StabilityOutcome::stable);
    EXPECT_EQ(at(1.25), StabilityOutcome::blown_up);
  }
}

TEST(StabilityCell, OfAnExplicitPushIsBoundedBelowItsLimitAndAnImplicitOneBeyondIt) {
  for (const Method method : {Method::implicit, Method::liu13, Method::quasi_newton}) {
    EXPECT_NE(stability_cell(method, StabilityAxis::explicit_push, 0.01, 3.9e4, 200).outcome,
              StabilityOutcome::blown_up);
    EXPECT_NE(stability_cell(method, StabilityAxis::implicit_push, 0.01, 1e9, 100).outcome, StabilityOutcome::blown_up);
  }
}

// Implicit Euler damps: the longer its step, the more.
TEST(StabilityCell, LosesMoreEnergyWithALongerStep) {
  double before = 0;
  for (const double step : {1e-4, 1e-3, 1e-2}) {
    const StabilityCell cell =
        stability_cell(Method::implicit, StabilityAxis::springs, step, 100, static_cast<int>(std::lround(0.3 / step)));
    EXPECT_EQ(cell.outcome, StabilityOutcome::converged);
    EXPECT_GT(cell.energy_error, before);
    before = cell.energy_error;
  }
  EXPECT_LT(before, 0.5);
}

}  // namespace
}  // namespace drape
