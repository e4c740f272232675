#include <gtest/gtest.h>

#include "sim/make_system.hpp"
#include "sim/schemes/registry.hpp"
#include "sim/schemes/substeps.hpp"
#include "sim/simulation.hpp"
#include "tests/support/setups.hpp"

namespace drape::test {
namespace {

class UnaskedAccuracy : public testing::TestWithParam<NamedMethod> {
 protected:
  UnaskedAccuracy() : settings_(homework(GetParam(), 0.001, 180)), system_(make_system(settings_)) {}

  /// What a simulation steps with, and how often another system is made for it.
  std::unique_ptr<Scheme> scheme() {
    const auto guard = make_guard(settings_, system_);
    return make_scheme(settings_, system_, *guard, [this](double step) {
      ++systems_;
      return make_system(settings_, step);
    });
  }

  SimulationSettings settings_;
  System system_;
  int systems_ = 0;
};
INSTANTIATE_TEST_SUITE_P(With, UnaskedAccuracy, testing::ValuesIn(all_methods), method_name);

// Nothing stands between a simulation and the method's own scheme, so there is nothing that could cost anything.
TEST_P(UnaskedAccuracy, MakesNothingBesideTheScheme) {
  const auto plain = scheme();
  EXPECT_EQ(dynamic_cast<SubstepScheme*>(plain.get()), nullptr);
  EXPECT_EQ(systems_, 0);
  settings_.integrator.stop.reset();
  settings_.integrator.tolerance.reset();
  settings_.accuracy = 1e-3;
  const auto asked = scheme();
  EXPECT_NE(dynamic_cast<SubstepScheme*>(asked.get()), nullptr);
  EXPECT_GT(systems_, 0);
}

TEST_P(UnaskedAccuracy, GivesTheBitsOfTheScheme) {
  const auto scheme = method_type(settings_.integrator.method).make(settings_.integrator, system_);
  State state{.x = settings_.cloth.positions, .v = settings_.cloth.velocities, .step = 0};
  StepForces forces(system_, state);
  Simulation simulation(settings_);
  for (int i = 0; i < 20; ++i) {
    const StepReport plain = scheme->advance(state, forces), report = simulation.step();
    ++state.step;
    EXPECT_EQ(report.iterations, plain.iterations);
    EXPECT_EQ(report.substeps, 1);
    EXPECT_FALSE(report.estimate);
  }
  EXPECT_TRUE(same_bits(simulation.state().x, state.x));
  EXPECT_TRUE(same_bits(simulation.state().v, state.v));
}

}  // namespace
}  // namespace drape::test
