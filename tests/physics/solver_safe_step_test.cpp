#include <gtest/gtest.h>

#include <numbers>

#include "drape/sim/simulation.hpp"
#include "sim/stability.hpp"
#include "tests/support/cloths.hpp"

namespace drape {
namespace {

/// Makes n+2 vertices in a row, with pinned ends.
Cloth chain(int n, double stiffness, double mass) {
  Cloth cloth;
  cloth.positions = Vertices::Zero(n + 2, 3);
  for (int v = 0; v < n + 2; ++v) cloth.positions(v, 0) = v;
  cloth.velocities = Vertices::Zero(n + 2, 3);
  cloth.masses.setConstant(n + 2, mass);
  for (int v = 0; v <= n; ++v) cloth.springs.push_back({v, v + 1, 1.0, stiffness});
  cloth.pins = {0, n + 1};
  return cloth;
}

TEST(SafeStep, OfAChainIsThatOfItsHighestFrequency) {
  for (const int n : {1, 2, 17, 100}) {
    const Cloth cloth = chain(n, 50, 0.1);
    const double highest = 2 * std::sqrt(50 / 0.1) * std::sin(std::numbers::pi * n / (2.0 * (n + 1)));
    const double step = safe_step(System(cloth, 0.01));
    EXPECT_LE(step, 2 / highest * (1 + 1e-6)) << n;
    EXPECT_GE(step, 2 / highest * (1 - 1e-4)) << n;
  }
}

// Each Lanczos iteration queries the stop.
TEST(SafeStep, IsFoundOnceForACloth) {
  const auto looks = [](const Cloth& cloth, double* step) {
    int count = 0;
    System system(cloth, 0.01);
    system.stop = Stop([&count] { return ++count < 0; });
    *step = safe_step(system);
    return count;
  };
  Cloth cloth = chain(30, 70, 0.2);
  double first = 0, again = 0, heavier = 0;
  EXPECT_GT(looks(cloth, &first), 0);
  EXPECT_EQ(looks(cloth, &again), 0);
  EXPECT_EQ(again, first);
  cloth.masses[15] *= 4;
  EXPECT_GT(looks(cloth, &heavier), 0) << "it is another cloth";
  EXPECT_NE(heavier, first);
  cloth.masses[15] /= 4;
  cloth.springs[3].stiffness *= 2;
  EXPECT_GT(looks(cloth, &heavier), 0);
  EXPECT_LT(heavier, first);
  cloth.pins = {0, 15, 31};
  EXPECT_GT(looks(cloth, &heavier), 0);
}

TEST(SafeStep, OfClothWithoutFreeSpringsIsInfinite) {
  Cloth cloth = chain(1, 50, 0.1);
  cloth.pins = {0, 1, 2};
  EXPECT_EQ(safe_step(System(cloth, 0.01)), std::numeric_limits<double>::infinity());
}

SimulationSettings settings(double factor) {
  SimulationSettings s;
  s.cloth = test::grid_cloth(20);
  s.step = factor * safe_step(System(s.cloth, 1));
  s.integrator.method = Method::semi_implicit;
  s.effects = {Gravity{}};
  return s;
}

TEST(SafeStep, KeepsTheHomeworksClothStable) {
  Simulation simulation(settings(0.999));
  const double before = simulation.energies().total();
  for (int step = 0; step < 2000; ++step) simulation.step();
  EXPECT_LT(simulation.energies().total(), before + 1);
}

TEST(SafeStep, IsNamedToAScenesThatIsBeyondIt) {
  try {
    Simulation simulation(settings(1.01));
    FAIL() << "it was not refused";
  } catch (const UsageError& error) {
    EXPECT_NE(std::string(error.what()).find("is stable up to"), std::string::npos) << error.what();
  }
}

TEST(SafeStep, IsNearTheBorderBeyondWhichTheClothExplodes) {
  SimulationSettings s = settings(1.3);
  s.integrator.allow_unstable = true;
  Simulation simulation(std::move(s));
  const auto run = [&] {
    for (int step = 0; step < 5000; ++step) simulation.step();
  };
  EXPECT_THROW(run(), DivergedError);
}

}  // namespace
}  // namespace drape
