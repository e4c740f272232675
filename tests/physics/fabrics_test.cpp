// Named fabrics in scenes: strips pulled along the warp, the weft and between, and strips clamped at one end.

#include <gtest/gtest.h>

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "drape/scene/scene.hpp"
#include "drape/sim/cloth.hpp"
#include "drape/sim/simulation.hpp"
#include "tests/support/cloths.hpp"
#include "tests/support/scene_folder.hpp"

namespace drape::test {
namespace {

constexpr double g = 9.8;

/// Returns the positions of a scene's cloth at rest, after steps so long that backward Euler removes all motion.
/// @param length of the cloth [m]
/// @param weight of the cloth [N]
Vertices at_rest(const std::string& cloth, double length, double weight) {
  const SceneFolder folder;
  const Scene scene =
      folder.load(cloth + "[time]\nstep = 0.05\nduration = 20\n[effects.gravity]\nacceleration = [0, 0, -9.8]\n" +
                  fmt::format("[integrator]\nmethod = \"quasi-newton\"\nstop = \"gradient\"\ntolerance = {}\n"
                              "max_iterations = 20000\n",
                              1e-6 * weight));
  Simulation simulation(scene.simulation);
  const auto speed = [&] { return simulation.state().v.cwiseAbs().maxCoeff(); };
  for (int i = 0; i < 400 && (i < 3 || speed() > 1e-6 * length); ++i) simulation.step();
  EXPECT_LE(speed(), 1e-6 * length) << "still moving";
  return simulation.state().x;
}

/// Returns the modulus of a hanging strip that the scene's text makes of a fabric, from its extension between a quarter
/// and half of its length above the free end. The pull there is uniaxial: the weight below.
/// @param warp angle between the strip and its warp [degrees]
double pulled(const Fabric& fabric, double warp) {
  constexpr int columns = 16, rows = 6 * columns;
  // So short that its own weight stretches it by up to a hundredth.
  const double length = 1e-2 * std::min(fabric.modulus.warp, fabric.modulus.weft) / (fabric.density * g);
  const double cell = length / rows;
  const std::string cloth = fmt::format(
      "[cloth]\nmesh = {{ grid = [{}, {}], size = [{}, {}], pattern = \"alternating\" }}\nmaterial = \"{}\"\n"
      "warp = {}\npins = [\"edge:y+\"]\n[cloth.transform]\nrotate = [90, 0, 0]\n",
      columns, rows, columns * cell, length, fabric.name, 90 + warp);
  const Vertices x = at_rest(cloth, length, fabric.density * g * length * columns * cell);
  const auto height = [&](int row) { return x.col(2).segment(Eigen::Index{row} * (columns + 1), columns + 1).mean(); };
  const int quarter = rows / 4, half = rows / 2;
  const double low = quarter * cell, high = half * cell;
  const double extension = std::abs(height(half) - height(quarter)) - (high - low);
  return fabric.density * g * (high * high - low * low) / 2 / extension;
}

class NamedFabric : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(, NamedFabric, testing::Values("denim", "jet-set", "ribbon", "sweat"), [](const auto& tested) {
  std::string name = tested.param;
  std::erase(name, '-');
  return name;
});

// Triangles at the free sides have one diagonal each and are softer: an error of the width of a cell.
TEST_P(NamedFabric, StretchesByItsModuliAlongWarpAndWeftAndBetween) {
  const Fabric& f = fabric(GetParam());
  const double between = std::pow((1 / std::sqrt(f.modulus.warp) + 1 / std::sqrt(f.modulus.weft)) / 2, -2);
  for (const auto& [angle, theory] : {std::pair{0.0, f.modulus.warp}, {45.0, between}, {90.0, f.modulus.weft}}) {
    EXPECT_NEAR(pulled(f, angle), theory, 0.02 * theory) << angle;
  }
}

/// Returns the sag of the tip of a clamped strip of a fabric, in its length. The strip is so long that w L³/D = 1.
/// @param warp angle between the strip and its warp, 0 or 90 [degrees]
double sag(const Fabric& fabric, double warp) {
  constexpr int cells = 20, across = 6;
  const double rigidity = warp == 0 ? fabric.rigidity.warp : fabric.rigidity.weft;
  const double length = std::cbrt(rigidity / (fabric.density * g)), cell = length / cells;
  // One more column of cells is in the clamp.
  const std::string cloth = fmt::format(
      "[cloth]\nmesh = {{ grid = [{}, {}], size = [{}, {}], pattern = \"alternating\" }}\nmaterial = \"{}\"\n"
      "warp = {}\npins = [{{ box = [[-1, -1, -1], [{}, 1, 1]] }}]\n",
      cells + 1, across, length + cell, across * cell, fabric.name, warp, -(length + cell) / 2 + 1.01 * cell);
  const Vertices x = at_rest(cloth, length, fabric.density * g * length * across * cell);
  double sum = 0;
  for (int j = 0; j <= across; ++j) sum -= x(Eigen::Index{j} * (cells + 2) + cells + 1, 2);
  return sum / (across + 1) / length;
}

// Romero et al. 2021, "Physical validation of simulators in computer graphics". Fabrics are also stretched and sheared
// by their weight; only stiff ones hardly.
TEST_P(NamedFabric, SagsAsTheElasticaOfItsRigidityAlongWarpAndWeft) {
  constexpr double drop = 0.1235;
  for (const double warp : {0.0, 90.0}) EXPECT_NEAR(sag(fabric(GetParam()), warp), drop, 0.02 * drop) << warp;
}

}  // namespace
}  // namespace drape::test
