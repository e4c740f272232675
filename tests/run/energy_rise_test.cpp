// A run reports the energy that its cloth gained without work.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <nlohmann/json.hpp>

#include "drape/sim/effects/acceleration.hpp"
#include "drape/sim/effects/ground.hpp"
#include "run/run_scene.hpp"
#include "run/statistics.hpp"
#include "tests/support/setups.hpp"

namespace drape::test {
namespace {

constexpr int steps = 100;

/// Makes a tilted sheet that falls on a ground.
SimulationSettings falling_sheet(double stiffness, const Ground& ground) {
  Mesh sheet = make_grid(5, 5);
  sheet.positions *= 0.5;
  const Cloth flat = cloth_of(sheet, 0.22, stiffness, {});
  SimulationSettings settings;
  settings.cloth = flat;
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(1.0, Eigen::Vector3d(3, 1, 0).normalized()).toRotationMatrix();
  settings.cloth.positions = (flat.positions * turn.transpose()).rowwise() + Eigen::RowVector3d(0, 0, 0.6);
  settings.step = 0.01;
  settings.integrator.method = Method::quasi_newton;
  settings.effects = {Gravity{}, ground};
  return settings;
}

/// Simulates it and returns the run's statistics.
Statistics watch(const SimulationSettings& settings) {
  Statistics statistics;
  Simulation simulation(settings);
  const std::array<StepObserver*, 1> observers{&statistics};
  run_steps(simulation, steps, observers, {});
  statistics.finish(simulation);
  return statistics;
}

TEST(EnergyRise, IsWhatTheClothHasMoreThanAtTheStart) {
  const Simulation simulation(falling_sheet(180, {.height = 0}));
  Statistics statistics;
  statistics.begin(simulation);
  const double first = simulation.energies().total(), fallen = 0.3;
  for (const double rise : {0.0, 0.7, 0.2}) {
    Energies now = simulation.energies();
    now.gravity -= fallen;
    now.kinetic += fallen + rise;
    StepRow row{};
    row.step = rise == 0 ? 0 : 1;
    row.energies = now;
    statistics.replay(row, 0, 0);
  }
  const auto rise = statistics.energy_rise();
  ASSERT_TRUE(rise);
  EXPECT_NEAR(rise->energy, 0.7, 1e-12);
  EXPECT_TRUE(rise->notable());
  const auto json = nlohmann::json::parse(statistics.to_json("completed"));
  EXPECT_EQ(json["energy_rise"]["energy"], rise->energy);
  EXPECT_EQ(json["energy_rise"]["of_available"], rise->of_available);
  EXPECT_GT(first, 0);
}

TEST(EnergyRise, IsNoneWhereAClothFallsOnAGround) {
  for (const double stiffness : {18.0, 18000.0}) {
    const auto rise = watch(falling_sheet(stiffness, {.height = 0})).energy_rise();
    ASSERT_TRUE(rise);
    EXPECT_FALSE(rise->notable()) << rise->energy << " J, " << rise->of_available;
  }
}

TEST(EnergyRise, IsNotAskedForWhereSomethingGivesEnergyOrNothingTouches) {
  const Ground ground{.height = 0};
  SimulationSettings blown = falling_sheet(18, ground), pushed = blown, alone = blown, explicit_method = blown;
  blown.effects.add(Wind{.acceleration = Eigen::Vector3d(1, 0, 0)});
  Sphere thrown = homework_sphere();
  thrown.velocity = Eigen::Vector3d(1, 0, 0);
  pushed.effects.add(thrown);
  alone.effects = {Gravity{}};
  explicit_method.integrator.method = Method::verlet;
  explicit_method.step = 1e-3;
  for (const SimulationSettings* settings : {&blown, &pushed, &alone, &explicit_method}) {
    Simulation simulation(*settings);
    EXPECT_FALSE(simulation.only_loses_energy());
    Statistics statistics;
    run_steps(simulation, 2, std::array<StepObserver*, 1>{&statistics}, {});
    EXPECT_FALSE(statistics.energy_rise());
    EXPECT_TRUE(nlohmann::json::parse(statistics.to_json("completed"))["energy_rise"].is_null());
  }
}

}  // namespace
}  // namespace drape::test
