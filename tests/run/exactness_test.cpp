// A run reports its error: 2 m of chain between two points 1.2 m apart sag by 0.72556 m.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "run/run_scene.hpp"
#include "run/statistics.hpp"
#include "tests/support/setups.hpp"

namespace drape::test {
namespace {

constexpr double sag = 0.72556;

/// Makes a chain of 40 stiff springs that starts as a V.
SimulationSettings catenary(Solver solver) {
  constexpr int springs = 40;
  SimulationSettings settings;
  Cloth& chain = settings.cloth;
  chain.positions = chain.velocities = Vertices::Zero(springs + 1, 3);
  chain.masses.setConstant(springs + 1, 0.1 / springs);
  chain.pins = {0, springs};
  for (int i = 0; i <= springs; ++i) {
    const double along = 2.0 * i / springs - 1;
    chain.positions.row(i) << 0.6 * along, 0, -0.8 * (1 - std::abs(along));
    if (i > 0) chain.springs.push_back({.i = i - 1, .j = i, .rest_length = 2.0 / springs, .stiffness = 3e4});
  }
  settings.step = 0.01;
  settings.effects = {Gravity{}, Damping{.factor = 1e-3}};
  settings.integrator.method = solver.method;
  settings.integrator.linear_solver = solver.linear_solver;
  return settings;
}

struct Outcome {
  double wrong;  ///< relative error of the sag
  Statistics statistics;
  /// Returns true if the run warns about its result.
  [[nodiscard]] bool doubtful() const {
    const ErrorMonitor& exactness = statistics.exactness();
    return exactness.coarse() || (exactness.residual_force() && exactness.residual_force()->notable());
  }
};

Outcome run(const SimulationSettings& settings) {
  Outcome outcome{};
  Simulation simulation(settings);
  const std::array<StepObserver*, 1> observers{&outcome.statistics};
  run_steps(simulation, 400, observers, {});
  outcome.statistics.finish(simulation);
  outcome.wrong = std::abs(-simulation.state().x.col(2).minCoeff() - sag) / sag;
  return outcome;
}

class Exact : public testing::TestWithParam<NamedMethod> {};
INSTANTIATE_TEST_SUITE_P(With, Exact, testing::ValuesIn(implicit_methods), method_name);

TEST_P(Exact, AMethodGetsThereByDefaultOrSaysByHowMuchItDidNot) {
  const Outcome outcome = run(catenary(GetParam()));
  const bool there = outcome.wrong < 0.003;
  EXPECT_TRUE(there || outcome.doubtful()) << outcome.wrong << " wrong, and " << outcome.statistics.to_json("");
  if (GetParam().method != Method::liu13) {
    EXPECT_TRUE(there) << outcome.wrong;
    EXPECT_FALSE(outcome.doubtful()) << outcome.statistics.to_json("");
  }
}

TEST_P(Exact, AndSoItDoesWithARuleByChange) {
  SimulationSettings settings = catenary(GetParam());
  settings.integrator.tolerance = 1e-3;
  const Outcome outcome = run(settings);
  EXPECT_TRUE(outcome.wrong < 0.003 || outcome.doubtful())
      << outcome.wrong << " wrong, and " << outcome.statistics.to_json("");
}

TEST(ErrorMonitor, IsInTheStatistics) {
  SimulationSettings settings = catenary(Method::liu13);
  settings.integrator.tolerance = 1e-3;
  const Outcome outcome = run(settings);
  EXPECT_GT(outcome.wrong, 0.01);  // a rule by change stops such a stiff chain too early
  const auto accuracy = nlohmann::json::parse(outcome.statistics.to_json("completed"))["accuracy"];
  EXPECT_EQ(accuracy["stop"], "change");
  EXPECT_EQ(accuracy["tolerance"], 1e-3);
  EXPECT_GT(accuracy["estimated_error"]["mean"], 1e-5);
  EXPECT_GE(accuracy["estimated_error"]["largest"], accuracy["estimated_error"]["mean"]);
  EXPECT_GT(accuracy["unbalanced_at_rest"]["of_weight"], 0.01);
}

TEST(ErrorMonitor, OfAMethodThatSolvesNothingIsNoQuestion) {
  SimulationSettings settings = catenary(Method::semi_implicit);
  settings.step = 1e-5;
  EXPECT_TRUE(nlohmann::json::parse(run(settings).statistics.to_json("completed"))["accuracy"].is_null());
}

}  // namespace
}  // namespace drape::test
