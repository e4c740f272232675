#include "study/stability.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "drape/sim/simulation.hpp"
#include "sim/stability.hpp"
#include "study/stability_map.hpp"

namespace drape {
namespace {

struct Border {
  StepMethod method;
  StabilityAxis axis;
  double stiffness;
};
class StabilityBorders : public ::testing::TestWithParam<Border> {};
INSTANTIATE_TEST_SUITE_P(Of, StabilityBorders,
                         ::testing::Values(Border{Method::semi_implicit, StabilityAxis::springs, 1e-2},
                                           Border{Method::semi_implicit, StabilityAxis::springs, 1e3},
                                           Border{Method::semi_implicit, StabilityAxis::springs, 1e8},
                                           Border{Method::semi_implicit, StabilityAxis::push, 1e2},
                                           Border{Method::semi_implicit, StabilityAxis::push, 1e7},
                                           Border{Method::implicit, StabilityAxis::push, 1},
                                           Border{Method::implicit, StabilityAxis::push, 1e6},
                                           Border{Method::liu13, StabilityAxis::push, 1e3},
                                           Border{Method::liu13, StabilityAxis::push, 1e8},
                                           Border{Method::quasi_newton, StabilityAxis::push, 1e4},
                                           Border{Method::quasi_newton, StabilityAxis::push, 1e8},
                                           Border{Method::verlet, StabilityAxis::springs, 1e3},
                                           Border{Method::verlet, StabilityAxis::push, 1e7},
                                           Border{{Method::quasi_newton, TimeScheme::sdirk2}, StabilityAxis::push, 1e4},
                                           Border{{Method::liu13, TimeScheme::sdirk2}, StabilityAxis::push, 1e8}));

TEST_P(StabilityBorders, LieWhereTheyArePredicted) {
  const auto [method, axis, stiffness] = GetParam();
  const StabilityLimit border = stability_border(method, axis, stiffness);
  EXPECT_GE(border.measured / border.predicted, 0.98);
  EXPECT_LE(border.measured / border.predicted, 1.2);
}

// If a flat cloth's springs and the push are equally stiff, each moves in directions in which the other does not
// resist. The bound that adds them is then too small by √2, in addition to its margin for springs alone.
TEST(StabilityLimit, IsBeyondThePredictionWhereSpringsAndPushDoNotAddUp) {
  constexpr double stiffness = 1.4e5;
  const StabilityLimit border = stability_border(Method::semi_implicit, StabilityAxis::push, stiffness);
  EXPECT_GE(border.measured / border.predicted, 0.98);
  EXPECT_LE(border.measured, 2 / std::sqrt(stiffness) * 1.002);
}

// Cells on both sides of a map's line, with as many steps as a map has.
TEST_P(StabilityBorders, PartTheCellsOfAMap) {
  const auto& [method, axis, stiffness] = GetParam();
  const double limit = stability_limit(method, axis, stiffness);
  const auto at = [&, method = method, axis = axis, stiffness = stiffness](double factor) {
    return stability_cell(method, axis, factor * limit, stiffness, 100).outcome;
  };
  EXPECT_EQ(at(0.95), is_explicit(method.method) ? StabilityOutcome::stable : StabilityOutcome::converged);
  EXPECT_EQ(at(1.25), StabilityOutcome::blown_up);
}

// Implicit Euler damps more with longer steps.
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
