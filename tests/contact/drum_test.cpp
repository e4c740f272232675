// Friction along a contact: Euler and Eytelwein's ratio on a drum, and what a turntable carries with it.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "drape/sim/effects/damping.hpp"
#include "tests/contact/contact_setup.hpp"

namespace drape::test {
namespace {

using Eigen::RowVector3d;
using Eigen::Vector3d;

constexpr double drum_friction = 0.3, drum_radius = 0.1, strap_width = 0.02;
constexpr int on_drum = 18, light_cells = 4, heavy_cells = 6;

class Drum : public Solved {
 protected:
  /// A light strap over a drum, with a weight at each end.
  /// @param ratio of the weights
  [[nodiscard]] SimulationSettings strap(double ratio, double modulus) const {
    const double reach = drum_radius + distance, cell = std::numbers::pi * reach / on_drum;
    constexpr int cells_along = light_cells + on_drum + heavy_cells;
    Mesh mesh = make_grid(cells_along, 1);
    for (Eigen::Index i = 0; i < mesh.positions.rows(); ++i) {
      const double s = cell * (static_cast<double>(i % (cells_along + 1)) - light_cells);
      const double angle = std::clamp(s / reach, 0.0, std::numbers::pi), beyond = s - angle * reach;
      mesh.positions.row(i) << -reach * std::cos(angle), 0.5 * strap_width * mesh.positions(i, 1),
          reach * std::sin(angle) - std::abs(beyond);
    }
    Cloth cloth = make_cloth(mesh, mesh, 1, 1, {});
    share_mass_by_area(1e-3, cloth);
    stiffen_by_area(modulus, cloth);
    for (int row = 0; row < 2; ++row) {
      const Eigen::Index first = Eigen::Index{row} * (cells_along + 1);
      cloth.masses[first] += 0.005;
      cloth.masses[first + cells_along] += 0.005 * ratio;
    }
    SimulationSettings result = settings(cloth, 0.005);
    result.effects.add(Damping{.factor = 1e-2});
    const BodyShape drum{.kind = BodyShape::Kind::cylinder, .radius = drum_radius, .height = 0.2};
    result.effects.add(
        Body{.rotate = Vector3d(90, 0, 0), .thickness = distance, .friction = drum_friction, .shape = drum});
    return divided(result);
  }
};
INSTANTIATE_TEST_SUITE_P(Nightly, Drum, testing::ValuesIn(all_contact_methods), method_name);

/// How fast the strap moves over the drum once it has stopped to swing [m/s].
double slipping(const SimulationSettings& settings) {
  Simulation simulation(settings);
  run(simulation, 1.2);
  const RowVector3d from = simulation.state().x.row(light_cells + on_drum / 2);
  run(simulation, 1.4);
  return (simulation.state().x.row(light_cells + on_drum / 2) - from).norm() / 0.2;
}

TEST_P(Drum, HoldsTheRatioOfEulerAndEytelwein) {
  const double right = std::exp(drum_friction * std::numbers::pi);
  for (const double modulus : {100.0, 1e3, 1e4}) {
    EXPECT_LT(slipping(strap(0.97 * right, modulus)), 1e-3) << modulus;
    EXPECT_GT(slipping(strap(1.03 * right, modulus)), 1e-2) << modulus;
  }
}

class Turntable : public Solved {};
INSTANTIATE_TEST_SUITE_P(With, Turntable, testing::ValuesIn(contact_methods), method_name);

/// How much further from the axis a patch ends that begins with the speed of the table [m].
double carried_outwards(SimulationSettings s, double load) {
  constexpr double from_axis = 0.3;
  const double rate = std::sqrt(load * drum_friction * g / from_axis);
  for (Eigen::Index i = 0; i < s.cloth.positions.rows(); ++i) {
    s.cloth.positions(i, 0) += from_axis;
    s.cloth.velocities.row(i) = Vector3d(0, 0, rate).cross(Vector3d(s.cloth.positions.row(i).transpose())).transpose();
  }
  Body table = solved_box({1, 1, 0.1}, 0);
  table.friction = drum_friction;
  table.orbit_period = 2 * std::numbers::pi / rate;
  table.orbit_center = *table.center;
  s.effects.add(table);
  Simulation simulation(s);
  run(simulation, 0.5);
  return mean_of(simulation.cloth(), simulation.state().x).head<2>().norm() - from_axis;
}

TEST_P(Turntable, CarriesWhatFrictionHoldsAndNoMore) {
  for (const double step : {0.002, 0.01}) {
    const SimulationSettings patch = exact(settings(plain_sheet(level_square(0.02, 2, distance), 1800), step));
    EXPECT_LT(std::abs(carried_outwards(patch, 0.97)), 1e-3) << step;
    EXPECT_GT(carried_outwards(patch, 1.05), 5e-3) << step;
  }
}

}  // namespace
}  // namespace drape::test
