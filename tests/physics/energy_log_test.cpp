#include <gtest/gtest.h>

#include <cmath>

#include "drape/sim/effects/acceleration.hpp"
#include "drape/sim/simulation.hpp"
#include "tests/support/plain_springs.hpp"
#include "tests/support/setups.hpp"

namespace drape::test {
namespace {

/// Expects a value that rounds, to six significant digits, to the printed one or its neighbour.
void expect_printed(double value, double printed, const char* what, int step) {
  const double last_digit = std::pow(10, std::floor(std::log10(std::abs(printed))) - 5);
  EXPECT_LE(std::abs(value - printed), 1.5 * last_digit) << what << " at step " << step;
}

TEST(EnergyLog, HasTheHomeworksNumbers) {
  struct Row {
    int step;
    double kinetic, gravity, elastic;
  };
  // The elastic energy before step 10 is below the rounding error of the lengths.
  constexpr Row rows[] = {
      {1, 4.78023e-05, -9.56045e-05, 0},        {5, 0.00119506, -0.00143407, 0},
      {10, 0.00478022, -0.00525825, 6.002e-10}, {13, 0.00807857, -0.0087, 4.016e-09},
      {16, 0.0122374, -0.0130022, 1.8284e-08},  {20, 0.0191208, -0.0200769, 9.43816e-08},
  };
  Simulation simulation(homework(Method::semi_implicit, 0.001, 180));
  for (const Row& row : rows) {
    while (simulation.state().step < row.step) simulation.step();
    const Energies energies = simulation.energies();
    expect_printed(energies.kinetic, row.kinetic, "kinetic", row.step);
    expect_printed(energies.gravity, row.gravity, "gravity", row.step);
    if (row.elastic > 0) {
      EXPECT_NEAR(energies.elastic, row.elastic, 0.01 * row.elastic) << "elastic at step " << row.step;
    } else {
      EXPECT_LT(energies.elastic, 1e-11);
    }
    EXPECT_DOUBLE_EQ(energies.total(), energies.kinetic + energies.gravity + energies.elastic);
  }
}

TEST(EnergyLog, SumsWhatItsColumnsSay) {
  SimulationSettings settings = homework(Method::semi_implicit, 0.001, 180);
  for (int i = 0; i < 441; ++i) settings.cloth.masses[i] = 0.001 * (1 + i % 5);
  settings.effects.add(Wind{.acceleration = {3, 1, 0}});
  Simulation simulation(settings);
  for (int step = 0; step < 100; ++step) simulation.step();

  const State& state = simulation.state();
  double kinetic = 0, gravity = 0;
  for (int i = 0; i < 441; ++i) {
    kinetic += settings.cloth.masses[i] / 2 * state.v.row(i).squaredNorm();
    gravity += settings.cloth.masses[i] * 9.8 * state.x(i, 2);
  }
  const Energies energies = simulation.energies();
  EXPECT_NEAR(energies.kinetic, kinetic, 1e-12 * kinetic);
  EXPECT_NEAR(energies.gravity, gravity, 1e-12 * std::abs(gravity));
  EXPECT_NEAR(energies.elastic, plain_energy(settings.cloth.springs, state.x), 1e-12 * energies.elastic);
}

}  // namespace
}  // namespace drape::test
