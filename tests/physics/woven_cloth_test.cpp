// Strips of cloth with a warp and a weft: pulled in three directions, and clamped at one end.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "drape/sim/cloth.hpp"
#include "drape/sim/effects/bending.hpp"
#include "drape/sim/mesh.hpp"
#include "drape/sim/simulation.hpp"
#include "tests/support/setups.hpp"
#include "tests/support/sheets_to_bend.hpp"

namespace drape::test {
namespace {

constexpr double g = 9.8, density = 0.2, weight = density * g;  // per area [N/m²]

/// Returns a cloth at rest, after steps so long that backward Euler removes all motion.
Vertices at_rest(Cloth cloth, Effects effects) {
  SimulationSettings settings = setup(std::move(cloth), Method::quasi_newton, 0.5);
  settings.effects = std::move(effects);
  settings.effects.add(Gravity{.acceleration = {0, 0, -g}});
  settings.integrator.stop = StoppingRule::gradient;
  settings.integrator.tolerance = 1e-6;
  settings.integrator.max_iterations = 20000;
  Simulation simulation(std::move(settings));
  const auto speed = [&] { return simulation.state().v.cwiseAbs().maxCoeff(); };
  for (int i = 0; i < 200 && (i < 3 || speed() > 1e-6); ++i) simulation.step();
  EXPECT_LE(speed(), 1e-6) << "still moving";
  return simulation.state().x;
}

/// Returns the modulus of a strip that hangs by one end, from its extension between a quarter and half of its length
/// above the free end. There no border holds it, so the pull is uniaxial: the weight below.
/// @param warp angle between the strip and its warp [degrees]
double pulled(double warp, WarpWeft modulus, int columns) {
  const int rows = 6 * columns;
  const double cell = 0.2 / columns;
  const Mesh flat = make_grid(Grid{
      .columns = columns, .rows = rows, .pattern = GridPattern::alternating, .size = {{columns * cell, rows * cell}}});
  std::vector<int> top;
  for (int i = 0; i <= columns; ++i) top.push_back(rows * (columns + 1) + i);
  Cloth cloth = cloth_of(flat, 1, 1, top);
  modulus.angle = (90 + warp) * std::numbers::pi / 180;  // the strip runs along y
  share_mass_by_area(density, cloth);
  stiffen_as_woven(modulus, cloth);
  cloth.positions.col(2) = flat.positions.col(1);  // it hangs along z
  cloth.positions.col(1).setZero();
  const Vertices x = at_rest(std::move(cloth), {});
  const auto height = [&](int row) { return x.col(2).segment(Eigen::Index{row} * (columns + 1), columns + 1).mean(); };
  const int quarter = rows / 4, half = rows / 2;
  const double low = quarter * cell, high = half * cell;
  const double extension = height(half) - height(quarter) - (high - low);
  return weight * (high * high - low * low) / 2 / extension;
}

// Triangles at the free sides have one diagonal each and are softer: an error of the width of a cell.
TEST(WovenStrip, StretchesByItsModulusAlongWarpAndWeftAndBetween) {
  const WarpWeft modulus(4000, 1000);
  const double between = std::pow((1 / std::sqrt(4000.0) + 1 / std::sqrt(1000.0)) / 2, -2);
  for (const auto& [angle, theory] : {std::pair{0.0, 4000.0}, {45.0, between}, {90.0, 1000.0}}) {
    const double coarse = std::abs(pulled(angle, modulus, 8) / theory - 1);
    const double fine = std::abs(pulled(angle, modulus, 16) / theory - 1);
    EXPECT_LT(fine, 0.02) << angle;
    EXPECT_LT(fine, std::max(0.6 * coarse, 0.005)) << angle;
  }
}

/// Returns the sag of the tip of a clamped strip of 1 m along x.
double sag(Division division, double warp, WarpWeft rigidity) {
  const Sheet sheet = clamped_strip(division, 20, 6, 1);
  Cloth cloth = cloth_of(sheet.mesh, 1, 1, sheet.pins);
  share_mass_by_area(density, cloth);
  stiffen_by_area(1e4 * weight, cloth);
  rigidity.angle = warp * std::numbers::pi / 180;
  const Vertices rest = at_rest(cloth, {Bending{.rigidity = rigidity}});
  return tip_drop(sheet, rest);
}

// The elastica of a heavy strip with w L³/D = 1 sags by 0.1235 (see materials_test.cpp). Along the warp the strip has
// that rigidity and a tenth across it; along the weft the other way round.
TEST(WovenStrip, SagsAsTheElasticaOfItsOwnRigidity) {
  constexpr double drop = 0.1235;
  for (const Division division : {Division::diagonal, Division::alternating}) {
    EXPECT_NEAR(sag(division, 0, {weight, weight / 10}), drop, 0.02 * drop) << name_of(division);
    EXPECT_NEAR(sag(division, 90, {weight / 10, weight}), drop, 0.02 * drop) << name_of(division);
  }
}

}  // namespace
}  // namespace drape::test
