#include <gtest/gtest.h>

#include <regex>
#include <string>

#include "drape/sim/simulation.hpp"
#include "tests/support/setups.hpp"

namespace drape::test {
namespace {

SimulationSettings far_too_large_step(Solver solver) {
  SimulationSettings settings = setup(cloth_of(make_grid(6, 6), 1, 1800, {0, 6}), solver, 0.1);
  settings.effects = {Gravity{}};
  settings.integrator.allow_unstable = true;
  return settings;
}

TEST(Divergence, NamesTheStepAndTheFastestVertex) {
  Simulation simulation(far_too_large_step(Method::semi_implicit));
  try {
    for (int step = 0; step < 2000; ++step) simulation.step();
    FAIL() << "a step of h·ω > 2 cannot be stable";
  } catch (const DivergedError& error) {
    EXPECT_EQ(error.kind(), ErrorKind::diverged);
    const std::string message = error.what();
    std::smatch step, vertex;
    ASSERT_TRUE(std::regex_search(message, step, std::regex("step (\\d+)"))) << message;
    ASSERT_TRUE(std::regex_search(message, vertex, std::regex("vertex (\\d+)"))) << message;
    EXPECT_EQ(std::stoll(step[1]), simulation.state().step);
    const int i = std::stoi(vertex[1]);
    ASSERT_LT(i, 49);
    const double fastest = simulation.state().v.rowwise().norm().maxCoeff();
    EXPECT_EQ(simulation.state().v.row(i).norm(), fastest) << message;
  }
}

class Stability : public testing::TestWithParam<NamedMethod> {};
INSTANTIATE_TEST_SUITE_P(With, Stability, testing::ValuesIn(implicit_methods), method_name);

// The pins are at most a rest length per spring away, so a hanging cloth in balance is within a few metres of them.
TEST_P(Stability, ImplicitMethodsStandSuchAStep) {
  Simulation simulation(far_too_large_step(GetParam()));
  for (int step = 0; step < 200; ++step) simulation.step();
  EXPECT_LT(simulation.state().x.cwiseAbs().maxCoeff(), 4);
}

}  // namespace
}  // namespace drape::test
