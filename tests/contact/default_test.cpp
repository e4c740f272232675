// Contact with default settings: it adds no energy, and releases the cloth.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <string>

#include "drape/sim/cloth.hpp"
#include "drape/sim/effects/acceleration.hpp"
#include "drape/sim/schemes/method_choice.hpp"
#include "tests/contact/contact_setup.hpp"
#include "tests/support/cloths.hpp"

namespace drape::test {
namespace {

/// Returns the kinetic, elastic and potential energy [J].
double total(const Simulation& simulation) {
  const Energies e = simulation.energies();
  return e.kinetic + e.gravity + e.elastic;
}

/// Makes a sheet that falls edge first.
Mesh tilted(int cells) {
  Mesh mesh = level_square(1, cells, 0);
  const Eigen::AngleAxisd about_x(60 * EIGEN_PI / 180, Eigen::Vector3d::UnitX());
  const Eigen::AngleAxisd about_y(20 * EIGEN_PI / 180, Eigen::Vector3d::UnitY());
  const Eigen::Matrix3d turn = (about_y * about_x).toRotationMatrix();
  mesh.positions = (mesh.positions * turn.transpose()).eval();
  mesh.positions.col(2).array() += 0.8;
  return mesh;
}

/// Expects that the energy of a fall onto a static obstacle never rises by more than 1 % of its range.
void expect_to_lose(const SimulationSettings& settings, double seconds, const std::string& what) {
  Simulation simulation(settings);
  const double start = total(simulation);
  double highest = start;
  while (simulation.time() < seconds) {
    simulation.step();
    highest = std::max(highest, total(simulation));
  }
  EXPECT_LE(highest - start, 0.01 * std::abs(start)) << what;
  EXPECT_LT(total(simulation), start) << what;
}

TEST(DefaultContact, GivesASheetThatFallsOnTheGroundNoEnergyHoweverStiffItIs) {
  for (const double step : {0.002, 0.01, 0.02}) {
    for (const double stiffness : {18.0, 180.0, 1800.0, 18000.0}) {
      for (const double friction : {0.0, 0.5}) {
        SimulationSettings settings{.cloth = plain_sheet(tilted(12), stiffness), .step = step};
        settings.effects = {Gravity{}, Ground{.friction = friction}};
        expect_to_lose(settings, 0.8,
                       std::to_string(step) + " s, " + std::to_string(stiffness) + " N/m, " + std::to_string(friction));
      }
    }
  }
}

TEST(DefaultContact, GivesFabricsNoEnergyOnAnyObstacle) {
  for (const std::string name : {"interlock", "denim", "target"}) {
    const Fabric& material = test::fabric(name);
    const Mesh start = level_square(1, 12, 0.6);
    for (const bool itself : {false, true}) {
      SimulationSettings settings{.cloth = make_cloth(start, start, 1, 1, {}), .step = 0.01};
      share_mass_by_area(material.density, settings.cloth);
      stiffen_by_direction(material.modulus, settings.cloth);
      settings.effects = {Gravity{}, Bending{.rigidity = material.rigidity}, Ground{},
                          Body{.box = Eigen::Vector3d(0.5, 0.5, 0.4), .center = Eigen::Vector3d(0.1, 0, 0.2)}};
      if (itself) settings.effects.add(SelfCollision{});
      expect_to_lose(settings, 0.6, name + (itself ? " with self-collision" : ""));
    }
  }
}

TEST(DefaultContact, LetsGoOfASheetThatIsLiftedAtAnyStep) {
  for (const double step : {0.001, 0.002, 0.01}) {
    for (const bool on_body : {false, true}) {
      SimulationSettings settings{.cloth = plain_sheet(level_square(0.5, 5, 0.02)), .step = step};
      settings.effects = {Gravity{}, Field{.acceleration = {"0", "0", "19.8"}}};
      if (on_body) {
        settings.effects.add(Body{.box = Eigen::Vector3d(0.8, 0.8, 0.2), .center = Eigen::Vector3d(0, 0, -0.1)});
      } else {
        settings.effects.add(Ground{});
      }
      Simulation simulation(settings);
      run(simulation, 0.3);
      const double risen = simulation.state().x.col(2).mean() - 0.02;
      EXPECT_NEAR(risen, 0.5 * 10 * 0.3 * 0.3, 0.01) << step << (on_body ? " on a body" : " on the ground");
    }
  }
}

}  // namespace
}  // namespace drape::test
