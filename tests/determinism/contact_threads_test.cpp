#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "drape/sim/effects/body.hpp"
#include "drape/sim/effects/ground.hpp"
#include "drape/sim/effects/self_collision.hpp"
#include "drape/sim/simulation.hpp"
#include "tests/support/setups.hpp"

// Contact search and response have the same bits for any number of threads.

namespace drape::contact_threads {
using test::same_bits;
using test::setup;

namespace {

constexpr int cells = 92;  // enough vertices to be divided, and few more

Cloth flat_cloth() { return test::cloth_of(make_grid(cells, cells), 1, 180, {0, cells}); }

Cloth falling_cloth() {
  Cloth cloth = flat_cloth();
  cloth.velocities.rowwise() = Eigen::RowVector3d(1, 0.5, -3);
  return cloth;
}

/// Makes a cloth with a folded hem above the rest that comes down.
/// @param hem   its width [m]
/// @param speed [m/s]
Cloth folded_cloth(double hem, double speed) {
  constexpr double gap = 0.01;  // [m]
  Cloth cloth = flat_cloth();
  const double fold = cloth.rest.col(0).maxCoeff() - hem;
  for (Eigen::Index i = 0; i < cloth.positions.rows(); ++i) {
    const double beyond = cloth.rest(i, 0) - fold;
    if (beyond <= 0) continue;
    cloth.positions(i, 0) = fold - beyond;
    cloth.positions(i, 2) = gap;
    cloth.velocities.row(i) << 0.3, 0, -speed;
  }
  return cloth;
}

State moved(SimulationSettings settings, int threads, int steps) {
  settings.threads = threads;
  Simulation simulation(settings);
  for (int step = 0; step < steps; ++step) simulation.step();
  return simulation.state();
}

/// Compares steps by any number of threads, and requires that the last effect changes the motion.
void expect_the_same_bits(SimulationSettings settings, int steps = 1) {
  settings.integrator.max_iterations = 2;
#ifdef DRAPE_SANITIZED  // ten times slower, and looks for races rather than for other bits
  EXPECT_TRUE(moved(settings, 2, steps).x.allFinite());
  return;
#endif
  const State alone = moved(settings, 1, steps);
  for (const int threads : {2, 3}) {
    const State together = moved(settings, threads, steps);
    EXPECT_TRUE(same_bits(together.x, alone.x)) << threads << " threads";
    EXPECT_TRUE(same_bits(together.v, alone.v)) << threads << " threads";
  }
  Effects others;
  for (std::size_t i = 0; i + 1 < settings.effects.size(); ++i) others.add(settings.effects[i]);
  settings.effects = others;
  EXPECT_GT((moved(settings, 1, steps).x - alone.x).rowwise().norm().maxCoeff(), 1e-3) << "nothing touches";
}

TEST(ContactByThreads, OfAClothWithItselfHasTheSameBits) {
  SimulationSettings settings = setup(folded_cloth(0.2, 0.3), Method::liu13, 0.01);
  settings.effects = {Gravity{}, SelfCollision{.thickness = 0.006}};
  expect_the_same_bits(settings, 2);  // the first one ends above the thickness
}

// A hem that is too fast for a step to keep apart, and narrow, because such a step takes long.
TEST(ContactByThreads, OfAHemThatComesDownFastHasTheSameBits) {
  SimulationSettings settings = setup(folded_cloth(0.03, 0.7), Method::liu13, 0.01);
  settings.effects = {Gravity{}, SelfCollision{.thickness = 0.006}};
  expect_the_same_bits(settings);
}

/// Makes a body under the cloth that intersects it around its highest points in the first step.
Body hilly_body() {
  MeshMotion hills{.mesh = make_grid(9, 7)};
  for (Eigen::Index i = 0; i < hills.mesh.positions.rows(); ++i) {
    const double x = hills.mesh.positions(i, 0), y = hills.mesh.positions(i, 1);
    hills.mesh.positions(i, 2) = -0.05 + 0.02 * std::cos(9 * x) * std::cos(7 * y);
  }
  return {.mesh = std::make_shared<MeshMotion>(hills), .thickness = 0.006, .friction = 0.4};
}

TEST(ContactByThreads, OfABodyHasTheSameBits) {
  SimulationSettings settings = setup(falling_cloth(), Method::liu13, 0.01);
  settings.effects = {Gravity{}, hilly_body()};
  expect_the_same_bits(settings);
}

// A deforming body, whose contact is solved, and from which the cloth bounces.
TEST(ContactByThreads, OfADeformingBodyHasTheSameBits) {
  Body body = hilly_body();
  MeshMotion motion = *body.mesh;
  motion.times = {0, 1};
  motion.samples = {motion.mesh.positions, 1.5 * motion.mesh.positions};
  body.mesh = std::make_shared<MeshMotion>(motion);
  body.restitution = 0.5;
  SimulationSettings settings = setup(falling_cloth(), Method::liu13, 0.01);
  settings.effects = {Gravity{}, body};
  expect_the_same_bits(settings);
}

TEST(ContactByThreads, OfASphereThatIsSolvedForHasTheSameBits) {
  SimulationSettings settings = setup(falling_cloth(), Method::implicit, 0.01);
  settings.effects = {
      Gravity{}, Sphere{.center = Eigen::Vector3d(0.1, 0, -3), .radius = 2.98, .thickness = 0.02, .friction = 0.5}};
  expect_the_same_bits(settings);
}

TEST(ContactByThreads, OfAGroundThatThrowsBackHasTheSameBits) {
  SimulationSettings settings = setup(falling_cloth(), Method::liu13, 0.01);
  for (Eigen::Index i = 0; i < settings.cloth.positions.rows(); ++i) {
    settings.cloth.positions(i, 2) += 0.05 * std::sin(7 * settings.cloth.positions(i, 0));
  }
  settings.effects = {Gravity{}, Ground{.height = -0.03, .friction = 0.5, .restitution = 0.5}};
  expect_the_same_bits(settings);
}

}  // namespace
}  // namespace drape::contact_threads
