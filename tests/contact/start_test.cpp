// Cloth that begins where contact forbids it, where that is allowed: it is separated step by step and gains no more
// energy than that takes.

#include <gtest/gtest.h>

#include <algorithm>

#include "sim/contact/mesh_contacts.hpp"
#include "sim/start_overlap.hpp"
#include "tests/contact/contact_setup.hpp"

namespace drape::test {
namespace {

using Eigen::Vector3d;

class Start : public Solved {};
INSTANTIATE_TEST_SUITE_P(With, Start, testing::ValuesIn(contact_methods), method_name);

/// How a run separates what its last effect overlaps with.
struct Separated {
  double after = -1;       ///< [s]; negative: not at all
  double left_again = -1;  ///< when an overlap was found after that [s]
  double rise = 0;         ///< of the total energy above that of the start [J]
  double elastic = 0;      ///< the most that it had [J]
};

Separated separate(const SimulationSettings& settings, double seconds) {
  Simulation simulation(settings);
  const double start = simulation.energies().total();
  Separated result;
  while (simulation.time() < seconds - 1e-9) {
    simulation.step();
    result.rise = std::max(result.rise, simulation.energies().total() - start);
    result.elastic = std::max(result.elastic, simulation.energies().elastic);
    const bool overlaps =
        find_overlap(settings, settings.effects.size() - 1, simulation.state().x, simulation.time()).has_value();
    if (!overlaps && result.after < 0) result.after = simulation.time();
    if (overlaps && result.after >= 0) result.left_again = simulation.time();
  }
  return result;
}

/// Energy that a cloth has that goes as fast as what is separated [J].
double separating(const SimulationSettings& settings) {
  return 0.5 * settings.cloth.masses.sum() * separation_speed * separation_speed;
}
double weight(const SimulationSettings& settings) { return settings.cloth.masses.sum() * g; }

TEST_P(Start, UnderAGroundIsLifted) {
  for (const double step : {0.002, 0.01}) {
    constexpr double deep = 0.05;
    SimulationSettings s = settings(plain_sheet(level_square(0.5, 5, -deep)), step);
    Ground ground = solved_ground();
    ground.allow_overlap = true;
    s.effects.add(ground);
    const Separated found = separate(s, 1);
    EXPECT_NEAR(found.after, deep / separation_speed, 0.1) << step;
    EXPECT_LT(found.left_again, 0) << step;
    EXPECT_LE(found.rise, weight(s) * (deep + distance) + separating(s)) << step;
  }
}

/// Energy that separation may take beside what stretches the cloth: to be lifted out, and 1 % of a fall.
double allowed_rise(const SimulationSettings& settings, double lift, double fall) {
  return weight(settings) * (lift + 0.01 * fall) + separating(settings);
}

TEST_P(Start, WithinTheDistanceIsLegalAndSeparatedGently) {
  for (const double step : {0.002, 0.01}) {
    SimulationSettings s = settings(plain_sheet(level_square(0.5, 5, 0.2 * distance)), step);
    s.effects.add(solved_ground());
    EXPECT_FALSE(find_overlap(s, s.effects.size() - 1, s.cloth.positions, 0));
    Simulation simulation(s);
    const double start = simulation.energies().total();
    double rise = 0, highest = 0;
    while (simulation.time() < 0.5) {
      simulation.step();
      rise = std::max(rise, simulation.energies().total() - start);
      highest = std::max(highest, simulation.state().x.col(2).maxCoeff());
    }
    EXPECT_LE(rise, allowed_rise(s, 0.8 * distance, 0)) << step;
    EXPECT_NEAR(highest, distance, 0.05 * distance) << step << ": thrown up";
  }
}

// A rise of energy from there on has a source.
TEST_P(Start, WithinTheDistanceIsKnown) {
  for (const double height : {0.51, 0.56}) {
    SimulationSettings s = settings(plain_sheet(level_square(0.6, 6, height), 60), 0.01);
    s.effects.add(Sphere{.center = Eigen::Vector3d(0, 0, 0), .radius = 0.5, .thickness = 0.05});
    EXPECT_EQ(begins_too_near(s), height < 0.55);
  }
}

TEST_P(Start, InsideABallOrABoxIsBroughtOut) {
  for (const double step : {0.002, 0.01}) {
    constexpr double deep = 0.01;
    SimulationSettings ball = settings(plain_sheet(level_square(0.5, 8, -deep)), step), box = ball;
    ball.effects.add(Sphere{
        .center = Vector3d(0, 0, -0.2), .radius = 0.2, .thickness = distance, .friction = 0.3, .allow_overlap = true});
    Body body = solved_box({0.2, 0.3, 0.2}, 0);
    body.allow_overlap = true;
    box.effects.add(body);
    for (const SimulationSettings& s : {ball, box}) {
      const Separated found = separate(s, 0.4);
      EXPECT_GT(found.after, 0) << step << s.effects[1].name();
      EXPECT_LT(found.left_again, 0) << step << s.effects[1].name();
      // Across the edges of a box the cloth is stretched until it is around them: docs/reference/effects.md has
      // figures.
      if (s.effects[1].name() == Sphere::name) {
        EXPECT_LE(found.rise, allowed_rise(s, deep + distance, 1) + found.elastic) << step;
      }
    }
  }
}

// Unfinished steps shed the energy that no separation explains; measuring the effects' times changes none of that.
TEST_P(Start, HasTheSameBitsWhereEffectsAreTimed) {
  SimulationSettings s = settings(plain_sheet(level_square(0.5, 8, -0.01)), 0.01);
  Body body = solved_box({0.2, 0.3, 0.2}, 0);
  body.allow_overlap = true;
  s.effects.add(body);
  s.integrator.max_iterations = 3;
  Simulation plain(s), timed(s, Timing::effects);
  for (int step = 0; step < 30; ++step) {
    plain.step();
    timed.step();
    ASSERT_TRUE(same_bits(plain.state().x, timed.state().x)) << step;
  }
}

/// A sheet, and another that stands in it with its lowest row.
Mesh pierced_square() {
  Mesh strip = level_square(0.2, 4, 0);
  for (Eigen::Index i = 0; i < strip.positions.rows(); ++i) {
    const Eigen::RowVector3d flat = strip.positions.row(i);
    strip.positions.row(i) << flat.x(), 0.013, flat.y() + 0.07;
  }
  return together({level_square(0.5, 7, 0), strip});
}

TEST_P(Start, AcrossItselfIsBroughtBack) {
  for (const double step : {0.002, 0.01}) {
    SimulationSettings s = settings(plain_sheet(pierced_square()), step);
    s.effects = {SelfCollision{.thickness = distance, .allow_overlap = true}};
    const Separated found = separate(s, 0.5);
    EXPECT_GT(found.after, 0) << step;
    EXPECT_LT(found.left_again, 0) << step;
    EXPECT_LE(found.rise, 4 * separating(s)) << step;
  }
}

TEST_P(Start, AcrossAShellOrAroundASpikeIsBroughtBack) {
  SimulationSettings s = settings(plain_sheet(level_square(0.3, 5, 0.005)), 0.005);
  s.effects = {};
  SimulationSettings spiked = s;
  s.effects.add(Body{.center = Vector3d(0.12, 0, 0),
                     .rotate = Vector3d(0, 60, 0),
                     .thickness = distance,
                     .shape = BodyShape{.kind = BodyShape::Kind::plane, .width = 0.4, .depth = 0.5},
                     .allow_overlap = true});
  spiked.effects.add(
      Body{.center = Vector3d(0.01, 0.02, -0.05),
           .thickness = distance,
           .shape = BodyShape{.kind = BodyShape::Kind::cone, .radius = 0.03, .height = 0.2, .segments = 12},
           .allow_overlap = true});
  for (const SimulationSettings& one : {s, spiked}) {
    const Separated found = separate(one, 1.2);
    EXPECT_GT(found.after, 0);
    EXPECT_LT(found.left_again, 0);
  }
}

}  // namespace
}  // namespace drape::test
