// Cloth around a gas: equilibria that are known, momentum, energy, and contact.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "drape/sim/effects/ground.hpp"
#include "drape/sim/effects/pressure.hpp"
#include "drape/sim/effects/self_collision.hpp"
#include "drape/sim/simulation.hpp"
#include "sim/pressure/gas_energy.hpp"
#include "tests/support/audited_run.hpp"
#include "tests/support/closed_meshes.hpp"
#include "tests/support/random.hpp"
#include "tests/support/setups.hpp"

namespace drape::test {
namespace {

constexpr double radius = 0.3, modulus = 300, density = 0.2;

/// Makes a sphere of cloth at rest, or any other closed mesh.
Cloth fabric(const Mesh& mesh) {
  Cloth cloth = cloth_of(mesh, 1, 1, {});
  share_mass_by_area(density, cloth);
  stiffen_by_area(modulus, cloth);
  return cloth;
}

double volume(const Cloth& cloth, const Vertices& x) { return enclosed_volume(cloth.triangles, x); }

/// Returns the stretch s at which a sphere whose springs all stretch alike is in equilibrium: the derivative of
/// Σ k L²(s − 1)²/2 is p times that of the volume V s³.
template <class Law>
double stretch_of_a_sphere(const Cloth& cloth, const Law& pressure) {
  double sum = 0;
  for (const Spring& s : cloth.springs) sum += s.stiffness * s.rest_length * s.rest_length;
  const double rest = volume(cloth, cloth.rest);
  double low = 1, high = 1.5;
  for (int i = 0; i < 60; ++i) {
    const double s = (low + high) / 2;
    (sum * (s - 1) < pressure(rest * s * s * s) * 3 * rest * s * s ? low : high) = s;
  }
  return low;
}

class Pressured : public testing::TestWithParam<NamedMethod> {
 protected:
  /// Makes settings with a step that every method can take.
  static SimulationSettings settings_of(Cloth cloth, const Effects& effects) {
    SimulationSettings settings = setup(std::move(cloth), GetParam(), step_of_method());
    settings.effects = effects;
    settings.integrator.stop = StoppingRule::error;
    settings.integrator.tolerance = 1e-7;
    settings.integrator.max_iterations = 3000;
    return settings;
  }
  static double step_of_method() { return GetParam().is_explicit() ? 0.0002 : 0.005; }
  static std::int64_t steps(double seconds) { return std::llround(seconds / (step_of_method())); }
};
INSTANTIATE_TEST_SUITE_P(With, Pressured, testing::ValuesIn(all_methods), method_name);

TEST_P(Pressured, ASphereGrowsUntilItsTensionHoldsThePressure) {
  constexpr double p = 200, ambient = 1000;
  for (const Gas gas : {Gas::constant, Gas::ideal}) {
    const Cloth cloth = fabric(ball(4, radius));
    Simulation simulation(
        settings_of(cloth, {Pressure{.pressure = p, .gas = gas, .ambient = ambient}, Damping{.factor = 1e-12}}));
    for (std::int64_t step = 0; step < steps(0.8); ++step) ASSERT_TRUE(simulation.step().converged) << step;
    const double start = volume(cloth, cloth.positions);
    const double stretch = stretch_of_a_sphere(
        cloth, [&](double v) { return gas == Gas::constant ? p : (ambient + p) * start / v - ambient; });
    EXPECT_GT(stretch, gas == Gas::constant ? 1.05 : 1.01);
    // The triangles of a divided octahedron differ, so it grows out of shape a little.
    EXPECT_NEAR(std::cbrt(volume(cloth, simulation.state().x) / start) - 1, stretch - 1, 0.02 * (stretch - 1));
    EXPECT_LT(simulation.state().v.cwiseAbs().maxCoeff(), 1e-2);
  }
}

/// Makes a sphere that drifts and turns, under pressure from the first step on.
Cloth thrown() {
  Cloth cloth = fabric(ball(3, radius));
  for (int i = 0; i < cloth.vertex_count(); ++i) {
    const Eigen::RowVector3d x = cloth.positions.row(i);
    cloth.velocities.row(i) << 1 - 2 * x[1], 0.5 + 2 * x[0], -0.3 + std::sin(9 * x[0]);
  }
  return cloth;
}

TEST_P(Pressured, NoMomentumComesFromWithin) {
  const Cloth cloth = thrown();
  Simulation simulation(settings_of(cloth, {Pressure{.pressure = 200, .gas = Gas::ideal, .ambient = 1e4}}));
  for (int step = 0; step < 50; ++step) simulation.step();
  const Eigen::RowVector3d before = cloth.masses.transpose() * cloth.velocities;
  const Eigen::RowVector3d after = cloth.masses.transpose() * simulation.state().v;
  EXPECT_LT((after - before).norm(), 1e-11 * before.norm());
}

TEST_P(Pressured, ExplicitMethodsKeepTheAngularMomentum) {
  if (!GetParam().is_explicit()) GTEST_SKIP() << "backward Euler damps rotations";
  const Cloth cloth = thrown();
  const auto moment = [&](const Vertices& x, const Vertices& v) {
    Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
    for (int i = 0; i < cloth.vertex_count(); ++i) sum += cloth.masses[i] * x.row(i).cross(v.row(i));
    return sum;
  };
  Simulation simulation(settings_of(cloth, {Pressure{.pressure = 200}}));
  for (int step = 0; step < 500; ++step) simulation.step();
  const Eigen::RowVector3d before = moment(cloth.positions, cloth.velocities);
  EXPECT_LT((moment(simulation.state().x, simulation.state().v) - before).norm(), 1e-11 * before.norm());
}

// The gas is part of the elastic energy: explicit methods keep the total of a free sphere, implicit ones only lose.
TEST_P(Pressured, TheEnergyIsKeptOrLost) {
  for (const Gas gas : {Gas::constant, Gas::ideal}) {
    Simulation simulation(settings_of(thrown(), {Pressure{.pressure = 200, .gas = gas, .ambient = 1e4}}));
    const double before = simulation.energies().total();
    double least = before, most = before, moving = 0;
    for (std::int64_t step = 0; step < steps(0.2); ++step) {
      simulation.step();
      const Energies now = simulation.energies();
      least = std::min(least, now.total());
      most = std::max(most, now.total());
      moving = std::max(moving, now.kinetic);
    }
    EXPECT_LT(most - before, (GetParam().second_order() || GetParam().is_explicit() ? 5e-2 : 1e-9) * moving);
    if (!GetParam().is_explicit()) continue;
    EXPECT_LT(before - least, 5e-2 * moving);
  }
}

// A flat cushion falls on the ground while it is blown up: it stays above the ground and nothing passes through it.
TEST_P(Pressured, ACushionIsBlownUpOnTheGround) {
  for (const bool self : {false, true}) {
    Mesh mesh = two_discs(4, 0.1);
    mesh.positions *= 0.3;
    Random random(5);
    for (Eigen::Index i = 0; i < mesh.positions.rows(); ++i) mesh.positions(i, 2) += random.between(0.05, 0.051);
    Effects effects{Gravity{}, Pressure{.pressure = 60}, Ground{.friction = 0.4}, Damping{.factor = 0.3}};
    if (self) effects.add(SelfCollision{.thickness = 0.004});
    SimulationSettings settings = settings_of(fabric(mesh), effects);
    settings.integrator.tolerance = 1e-5;
    settings.integrator.max_iterations.reset();
    const Cloth cloth = settings.cloth;
    const AuditedRun run = audit_run(settings, steps(0.15));
    EXPECT_LT(run.deepest, 1e-6);
    if (self) {
      EXPECT_EQ(run.with_passages + run.with_crossings, 0) << (run.first.empty() ? "" : run.first.front());
    }
    Simulation simulation(settings);
    for (std::int64_t step = 0; step < steps(0.15); ++step) simulation.step();
    EXPECT_GT(volume(cloth, simulation.state().x), 2 * volume(cloth, cloth.positions));
  }
}

struct Balloon {
  double radius, height;  // relative to the length of a meridian from the middle to the rim
};

/// Blows up two flat discs until they rest, slowly enough that they do not wind up. Along meridians they hardly
/// stretch; across them they are slack, as a foil is that wrinkles as finely as it likes.
void blow_up(int rings, Balloon& balloon) {
  constexpr int meridians = 24;
  constexpr double pressure = 1, stiffness = 3000, slack = 1e-6;
  const Mesh mesh = gored_discs(meridians, rings, 0.2);
  Cloth cloth = cloth_of(mesh, 1, 1, {});
  share_mass_by_area(density, cloth);
  stiffen_by_area(stiffness, cloth);
  for (Spring& s : cloth.springs) {
    const Eigen::RowVector3d a = cloth.rest.row(s.i), b = cloth.rest.row(s.j);
    const bool meridian = std::abs(a.x() * b.y() - a.y() * b.x()) < 1e-9;
    if (!meridian) s.stiffness *= slack;
  }
  SimulationSettings settings = setup(cloth, Method::implicit, 0.05);
  settings.effects = {Pressure{.pressure = pressure}, Damping{.factor = 1e-3}};
  settings.integrator.stop = StoppingRule::error;
  settings.integrator.tolerance = 1e-6;
  settings.integrator.max_iterations = 1000;
  Simulation simulation(std::move(settings));
  const auto speed = [&] { return simulation.state().v.cwiseAbs().maxCoeff(); };
  for (int i = 0; i < 300 && (i < 20 || speed() > 1e-5); ++i) ASSERT_TRUE(simulation.step().converged);
  EXPECT_LE(speed(), 1e-5) << "still moving";
  const Vertices& x = simulation.state().x;
  const auto rim = x.bottomRows(meridians);
  double length = 0;
  for (int ring = 0; ring < rings; ++ring) {
    const int from = ring == 0 ? 0 : 1 + (ring - 1) * meridians;
    const Eigen::Index to = ring + 1 == rings ? x.rows() - meridians : 1 + ring * meridians;
    length += (cloth.rest.row(to) - cloth.rest.row(from)).norm();
  }
  balloon = {.radius = (rim.rowwise() - rim.colwise().mean()).leftCols(2).rowwise().norm().mean() / length,
             .height = (x.row(0) - x.row(1 + meridians * (rings - 1))).norm() / length};
}

// The mylar balloon: two discs that do not stretch, and wrinkle at no cost (Paulsen 1994, "What is the shape of a Mylar
// balloon?"). Its radius is 0.7627 of the flat one, and its height 0.599 of its diameter. A tension of the meridians
// alone gives this shape, as a foil that wrinkles freely has none across them.
TEST(MylarBalloon, HasTheKnownRadiusAndHeight) {
  std::vector<double> radius_errors, height_errors;
  for (const int rings : {3, 6, 12}) {
    Balloon balloon{};
    blow_up(rings, balloon);
    radius_errors.push_back(std::abs(balloon.radius / 0.7627 - 1));
    height_errors.push_back(std::abs(balloon.height / (2 * balloon.radius) / 0.599 - 1));
  }
  for (std::size_t i = 1; i < 3; ++i) {
    EXPECT_LT(radius_errors[i], radius_errors[i - 1]);
    EXPECT_LT(height_errors[i], height_errors[i - 1]);
  }
  EXPECT_LT(radius_errors.back(), 0.005);
  EXPECT_LT(height_errors.back(), 0.005);
}

}  // namespace
}  // namespace drape::test
