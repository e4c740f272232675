// Data that a strain limit keeps for the next step: State::restraint.

#include <gtest/gtest.h>

#include <cmath>

#include "drape/sim/effects/acceleration.hpp"
#include "drape/sim/effects/damping.hpp"
#include "drape/sim/effects/strain_limit.hpp"
#include "drape/sim/simulation.hpp"
#include "sim/system.hpp"
#include "tests/support/meshes.hpp"
#include "tests/support/setups.hpp"

namespace drape::test {
namespace {

// A cloth that hangs at its limits would end each step where its springs alone hold it. A solver that starts there has
// little left to do, and finds the same result as from anywhere.
TEST(StrainLimitRestraint, LetsTheNextStepBeginWhereTheClothWouldGo) {
  constexpr double tolerance = 1e-4;  // [m]
  for (const Method method : {Method::liu13, Method::quasi_newton}) {
    SCOPED_TRACE(static_cast<int>(method));
    SimulationSettings settings = setup(cloth_of(make_grid(20, 20), 1, 20, {0, 20}), method, 0.01);
    settings.integrator.stop = StoppingRule::error;
    settings.integrator.tolerance = tolerance;
    settings.integrator.max_iterations = 2000;
    settings.effects = {Gravity{}, drape::StrainLimit{.max_stretch = 1.1}, Damping{.factor = 0.05}};
    Simulation simulation(settings), timed(settings, Timing::effects);
    for (int i = 0; i < 200; ++i) {
      simulation.step();
      timed.step();
    }
    EXPECT_EQ(timed.hash(), simulation.hash()) << "who measures times is told of it, too";
    int knowing = 0, not_knowing = 0, held = 0;
    for (int i = 0; i < 50; ++i) {
      State forgetful = simulation.state();
      if (forgetful.restraint.acceleration.isZero(0)) {  // the limits were solved with the cloth
        simulation.step();
        continue;
      }
      ++held;
      forgetful.restraint.acceleration.resize(0, 3);
      EXPECT_NE(hash_of(forgetful), simulation.hash());
      timed.restore(forgetful);
      not_knowing += timed.step().iterations;
      knowing += simulation.step().iterations;
      EXPECT_LT((simulation.state().x - timed.state().x).rowwise().norm().maxCoeff(), 3 * tolerance);
    }
    EXPECT_GE(held, 20);
    EXPECT_LT(knowing, not_knowing);
  }
}

/// Returns the least number of sweeps that the limit needs in the step from a state, at most `most`.
int sweeps(SimulationSettings settings, const State& state, int most) {
  for (int n = 1; n <= most; ++n) {
    settings.effects = {Gravity{}, drape::StrainLimit{.max_stretch = 1.02, .iterations = n}, Damping{.factor = 0.1}};
    Simulation simulation(settings);
    simulation.restore(state);
    if (simulation.step().converged) return n;
  }
  return most + 1;
}

// The tensions of one step are a good start for the next.
TEST(StrainLimitRestraint, BeginsWithTheTensionsOfTheLastStep) {
  SimulationSettings settings = setup(cloth_of(make_grid(20, 20), 1, 20, {0, 20}), Method::liu13, 0.01);
  settings.effects = {Gravity{}, drape::StrainLimit{.max_stretch = 1.02}, Damping{.factor = 0.1}};
  Simulation simulation(settings);
  while (simulation.time() < 3) simulation.step();
  int knowing = 0, not_knowing = 0;
  for (int i = 0; i < 10; ++i) {
    const State& state = simulation.state();
    EXPECT_GT(state.restraint.tensions.maxCoeff(), 1) << "nothing was held";
    EXPECT_GE(state.restraint.tensions.minCoeff(), 0) << "an upper limit does not push";
    State forgetful = state;
    forgetful.restraint.tensions.resize(0);
    EXPECT_NE(hash_of(forgetful), simulation.hash());
    knowing += sweeps(settings, state, 100);
    not_knowing += sweeps(settings, forgetful, 100);
    simulation.step();
  }
  EXPECT_LE(2 * knowing, not_knowing);
}

// Superfluous tensions vanish: a cloth at rest stays there for any earlier tensions.
TEST(StrainLimitRestraint, LetsGoOfTensionsThatNothingNeeds) {
  const Cloth cloth = cloth_of(irregular_mesh(10), 1, 5, {0, 3});
  System system(cloth, 0.01);
  drape::StrainLimit{.max_stretch = 1.05, .min_stretch = 0.95}.install(system);
  for (const double tension : {1e-3, 1.0, 1e3, -1.0}) {
    State state{.x = cloth.positions, .v = Vertices::Zero(cloth.vertex_count(), 3)};
    state.restraint.tensions.setConstant(std::ssize(cloth.springs), tension);
    system.begin(state);
    Vertices v = state.v;
    system.filters.front()->apply(state.x, 0, system.step, v);
    EXPECT_TRUE(system.filters.front()->done()) << tension;
    EXPECT_LT(system.step * v.rowwise().norm().maxCoeff(), 1e-12) << tension;
    EXPECT_LT(system.filters.front()->restraint()->tensions.norm(), 1e-9) << tension;
  }
}

/// Returns the positions after a fall from a state with a limit.
Vertices end_of_fall(const Cloth& cloth, const State& state, const drape::StrainLimit& limit) {
  System system(cloth, 0.01);
  limit.install(system);
  Vertices v = state.v;
  v.col(2).array() -= 9.8 * system.step;
  for (const int pin : cloth.pins) v.row(pin).setZero();
  system.begin(state);
  system.filters.front()->apply(state.x, 0, system.step, v);
  EXPECT_TRUE(system.filters.front()->done());
  return state.x + system.step * v;
}

// Tensions several times too large vanish as well: the limit then comes as near to the nearest position as from zero.
TEST(StrainLimitRestraint, HoldsNoMoreThanItHasTo) {
  SimulationSettings settings = setup(cloth_of(make_grid(20, 20), 1, 1, {0, 20}), Method::quasi_newton, 0.01);
  settings.effects = {Gravity{}, drape::StrainLimit{}, Damping{.factor = 0.05}};
  Simulation simulation(settings);
  while (simulation.time() < 3) simulation.step();
  const Cloth& cloth = settings.cloth;
  const State knowing = simulation.state();
  State forgetful = knowing;
  forgetful.restraint = {};
  const Vertices nearest = end_of_fall(cloth, forgetful, {.iterations = 100000, .tolerance = 1e-7});
  const auto off = [&](const State& state) {
    return std::sqrt(cloth.masses.dot((end_of_fall(cloth, state, {}) - nearest).rowwise().squaredNorm()));
  };
  for (const double factor : {1, 2, 3, 10}) {
    State wrong = knowing;
    wrong.restraint.tensions *= factor;
    EXPECT_LT(off(wrong), 2 * off(forgetful)) << factor;
  }
}

}  // namespace
}  // namespace drape::test
