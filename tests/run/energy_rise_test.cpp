// A run reports the energy that its cloth gained without work.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <nlohmann/json.hpp>

#include "drape/sim/effects/acceleration.hpp"
#include "drape/sim/effects/ground.hpp"
#include "run/run_scene.hpp"
#include "run/statistics.hpp"
#include "sim/schemes/stability_guard.hpp"
#include "sim/stability.hpp"
#include "sim/system.hpp"
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

/// Returns the statistics of a run whose total energy differs by these amounts from that at the start.
Statistics replay(const Simulation& simulation, std::initializer_list<double> changes) {
  Statistics statistics;
  statistics.begin(simulation);
  constexpr double fallen = 0.3;
  StepRow row{};
  for (const double change : changes) {
    row.energies = simulation.energies();
    row.energies.gravity -= fallen;
    row.energies.kinetic += fallen + change;
    statistics.replay(row, 0, 0);
    ++row.step;
  }
  return statistics;
}

TEST(EnergyRise, IsWhatTheClothHasMoreThanEverBefore) {
  const Simulation simulation(falling_sheet(180, {.height = 0}));
  const Statistics statistics = replay(simulation, {0, -0.2, 0.1, -0.5, 0.2, -0.3});
  const auto rise = statistics.energy_rise();
  ASSERT_TRUE(rise);
  EXPECT_NEAR(rise->energy, 0.7, 1e-12);
  EXPECT_TRUE(rise->notable());
  const auto json = nlohmann::json::parse(statistics.to_json("completed"));
  EXPECT_EQ(json["energy_rise"]["energy"], rise->energy);
  EXPECT_EQ(json["energy_rise"]["of_available"], rise->of_available);
}

TEST(EnergyRise, IsThatAboveTheStartWhereAPushStoresEnergy) {
  SimulationSettings pushed = falling_sheet(180, {.height = 0});
  pushed.effects.add(homework_sphere());
  const auto rise = replay(Simulation(pushed), {0, -0.5, 0.2}).energy_rise();
  ASSERT_TRUE(rise);
  EXPECT_NEAR(rise->energy, 0.2, 1e-12);
}

TEST(EnergyRise, IsNoneWhereAClothFallsOnAGround) {
  for (const double stiffness : {18.0, 18000.0}) {
    for (const Method method : {Method::quasi_newton, Method::automatic}) {
      SimulationSettings settings = falling_sheet(stiffness, {.height = 0, .restitution = 1});
      settings.integrator.method = method;
      const auto rise = watch(settings).energy_rise();
      ASSERT_TRUE(rise);
      EXPECT_FALSE(rise->notable()) << rise->energy << " J, " << rise->of_available;
    }
  }
}

TEST(EnergyRise, IsSeenWhereStepsAreTooLong) {
  SimulationSettings settings = falling_sheet(18000, {.height = 0, .restitution = 1});
  settings.integrator.method = Method::semi_implicit;
  const double longest = safe_step(make_system(settings));
  settings.integrator.substeps = static_cast<int>(SubstepGuard::fewest_substeps(settings.step, longest));
  const auto rise = watch(settings).energy_rise();
  ASSERT_TRUE(rise);
  EXPECT_TRUE(rise->notable()) << rise->energy << " J, " << rise->of_available;
}

TEST(EnergyRise, IsNotAskedForWhereSomethingGivesEnergyOrNothingTouches) {
  const Ground ground{.height = 0};
  SimulationSettings blown = falling_sheet(18, ground), pushed = blown, alone = blown;
  blown.effects.add(Wind{.acceleration = Eigen::Vector3d(1, 0, 0)});
  Sphere thrown = homework_sphere();
  thrown.velocity = Eigen::Vector3d(1, 0, 0);
  pushed.effects.add(thrown);
  alone.effects = {Gravity{}};
  for (const SimulationSettings* settings : {&blown, &pushed, &alone}) {
    Simulation simulation(*settings);
    EXPECT_FALSE(simulation.only_loses_energy());
    Statistics statistics;
    run_steps(simulation, 2, std::array<StepObserver*, 1>{&statistics}, {});
    EXPECT_FALSE(statistics.energy_rise());
    EXPECT_TRUE(nlohmann::json::parse(statistics.to_json("completed"))["energy_rise"].is_null());
  }
}

// A cloth nearer than the contact distance is pushed out, which is no fault of a method.
TEST(EnergyRise, IsNotAskedForWhereTheClothBeginsTooNear) {
  for (const double height : {-0.3, -0.001}) {
    SimulationSettings settings = falling_sheet(180, {.height = 0});
    settings.cloth.positions = settings.cloth.rest;  // level: it can fall by no more than this height
    settings.cloth.velocities.col(0).setConstant(0.1);
    settings.effects = {Gravity{}};
    settings.effects.add(Ground{.height = height, .thickness = 0.02});
    settings.integrator.method = Method::quasi_newton;
    const auto rise = watch(settings).energy_rise();
    EXPECT_FALSE(rise && rise->notable()) << height;
    if (height < -0.1) {
      EXPECT_TRUE(rise);
    }
  }
}

}  // namespace
}  // namespace drape::test
