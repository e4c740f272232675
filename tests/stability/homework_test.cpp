// The homework's scenes for 10 000 steps with every method: finite, near their pins, and within their energy.

#include <gtest/gtest.h>

#include "drape/scene/scene.hpp"
#include "drape/sim/simulation.hpp"
#include "sim/stability.hpp"
#include "sim/system.hpp"
#include "tests/stability/traps.hpp"
#include "tests/support/methods.hpp"

namespace drape::test {
namespace {

using Homework = ::testing::TestWithParam<std::tuple<int, NamedMethod>>;

class LongHomework : public Homework {};
INSTANTIATE_TEST_SUITE_P(Nightly, LongHomework,
                         ::testing::Combine(::testing::Range(1, 6), ::testing::ValuesIn(all_methods)),
                         [](const auto& scene) {
                           return std::to_string(std::get<0>(scene.param)) + "_" + std::get<1>(scene.param).name;
                         });

TEST_P(LongHomework, StaysWithinItsEnergy) {
  const auto& [number, method] = GetParam();
  SimulationSettings settings =
      load_scene(DRAPE_SOURCE_DIR "/scenes/homework/" + std::to_string(number) + ".toml", {"integrator.method=liu13"})
          .simulation;
  settings.integrator.method = method.method;
  settings.integrator.linear_solver = method.linear_solver;
  settings.integrator.max_iterations.reset();
  settings.integrator.scheme = method.scheme;
  if (method.is_explicit()) {
    // Nearer to the safe step a crumpled cloth heats up in so many steps: see BlowUp in explicit_test.cpp.
    settings.step = std::min(settings.step, 0.5 * safe_step(make_system(settings)));
  }
  const FloatingPointTraps traps;
  Simulation simulation(settings);
  // A fall by twice the cloth's length gives each kilogram at most 2·9.8·3 J, and the sphere returns only its share.
  const double most = 2 * 9.8 * 3 * settings.cloth.masses.sum();
  int not_converged = 0;
  for (int step = 0; step < 10'000; ++step) {
    not_converged += simulation.step().converged ? 0 : 1;
    const Energies now = simulation.energies();
    ASSERT_LE(now.kinetic + now.elastic, most) << "step " << step;
  }
  EXPECT_LT(simulation.state().x.cwiseAbs().maxCoeff(), 12);
  std::printf("%d of 10000 steps did not converge\n", not_converged);
}

}  // namespace
}  // namespace drape::test
