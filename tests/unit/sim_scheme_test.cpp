#include <gtest/gtest.h>

#include "drape/sim/simulation.hpp"
#include "sim/schemes/implicit_schemes.hpp"
#include "sim/schemes/registry.hpp"
#include "sim/schemes/substeps.hpp"
#include "sim/spring_network.hpp"
#include "sim/system.hpp"
#include "tests/support/cloths.hpp"
#include "tests/support/setups.hpp"

namespace drape::test {
namespace {

class UnaskedAccuracy : public testing::TestWithParam<NamedMethod> {
 protected:
  UnaskedAccuracy() : settings_(homework(GetParam(), 0.001, 180)), system_(make_system(settings_)) {}

  /// Returns the scheme of a simulation, counting additional systems that it makes.
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

// A simulation uses the method's own scheme directly, without any overhead.
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

/// A fake minimiser that stretches the cloth, and slows it down as a whole so much that its total energy falls.
class SlowingStretcher final : public Minimiser {
 public:
  SlowingStretcher(const System& system, const StepObjective& objective, const IntegratorSettings& settings)
      : Minimiser(system, objective, settings, 1) {}

 private:
  double iterate(Iterate& point) override {
    point.x.col(0) *= 1.01;
    point.x.col(2).array() -= 0.01;
    point.value = objective().evaluate(point.x, point.gradient);
    return 1;
  }
  void find_newton_step(const Iterate&, Vertices& direction) override { direction.setZero(); }
};

// A solver's effect on the momentum of a free cloth is removed again; that must not hide energy that the cloth gained.
TEST(BackwardEuler, GivesNoEnergyToAFreeClothThatItsSolverHasSlowedDown) {
  Cloth cloth = test::grid_cloth(4);
  cloth.pins.clear();
  cloth.velocities.col(2).setOnes();
  const System system(cloth, 0.1);
  IntegratorSettings settings;
  settings.stop = StoppingRule::change;  // under this rule no point is accepted as it is
  settings.max_iterations = 1;
  State state{.x = cloth.positions, .v = cloth.velocities, .step = 0};
  StepForces forces(system, state);
  BackwardEuler scheme(system, [&](const StepObjective& objective) {
    return std::make_unique<SlowingStretcher>(system, objective, settings);
  });
  const auto energy = [&] {
    Vertices ignored = Vertices::Zero(state.x.rows(), 3);
    const SpringNetwork springs(system.springs, cloth.vertex_count(), one_thread());
    return cloth.masses.dot(state.v.rowwise().squaredNorm()) / 2 + springs.add_value_gradient(state.x, ignored);
  };
  const double before = energy();
  const StepReport report = scheme.advance(state, forces);
  EXPECT_LT(report.kept, 1);
  EXPECT_LE(energy(), before * (1 + 1e-12));
  EXPECT_NEAR(cloth.masses.dot(state.v.col(2)), 1, 1e-12);  // momentum
}

}  // namespace
}  // namespace drape::test
