// Several cloths in one simulation: each moves as if alone until they touch, and contact between them obeys its laws.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "drape/sim/effects/bending.hpp"
#include "drape/sim/effects/moving_pins.hpp"
#include "drape/sim/effects/self_collision.hpp"
#include "drape/sim/effects/strain_limit.hpp"
#include "tests/cloths/panels.hpp"
#include "tests/support/cloths.hpp"

namespace drape::test {
namespace {

using Eigen::RowVector3d;
using Eigen::Vector3d;

constexpr double g = 9.8;  // default gravity [m/s²]

void run(Simulation& simulation, int steps) {
  for (int i = 0; i < steps; ++i) simulation.step();
}

Cloth moved(Cloth cloth, const RowVector3d& by) {
  cloth.positions.rowwise() += by;
  return cloth;
}

class OfEveryMethod : public testing::TestWithParam<NamedMethod> {};
INSTANTIATE_TEST_SUITE_P(SeveralCloths, OfEveryMethod, testing::ValuesIn(all_methods), method_name);

TEST_P(OfEveryMethod, TwoCopiesFarApartMoveAsOneAlone) {
  const Cloth one = disturbed(grid_cloth(6));
  const RowVector3d far(8, 0, 0);
  const Effects effects{Gravity{}, Bending{.rigidity = 1e-3}, SelfCollision{.thickness = 0.02}};
  Simulation alone(exactly(one, GetParam(), 0.01, effects));
  Simulation both(exactly(joined({one, moved(one, far)}), GetParam(), 0.01, effects));
  run(alone, 20);
  run(both, 20);
  const Eigen::Index n = one.positions.rows();
  // Rounding of coordinates below 16 m grows with the motion.
  const double tolerance = GetParam().is_explicit() ? 1e-12 : 1e-6;
  EXPECT_LT((both.state().x.topRows(n) - alone.state().x).cwiseAbs().maxCoeff(), tolerance);
  EXPECT_LT(((both.state().x.bottomRows(n).rowwise() - far) - alone.state().x).cwiseAbs().maxCoeff(), tolerance);
}

// One hangs at its strain limit, and all of the other is carried away.
TEST_P(OfEveryMethod, PinsOfAnotherClothChangeNothing) {
  Cloth hanging = panel(6, 6, {0.8, 0.8}, {0, 0, 0}), other = panel(2, 2, {0.3, 0.3}, {5, 0, 0});
  hanging.pins = {42, 43, 44, 45, 46, 47, 48};
  const Eigen::Index n = hanging.positions.rows();
  for (int i = 0; i < other.positions.rows(); ++i) other.pins.push_back(i);
  const auto moved_to = [&](double depth) {
    const Cloth both = joined({hanging, other});
    SimulationSettings settings = exactly(both, GetParam(), 0.01, {Gravity{}, StrainLimit{.max_stretch = 1.02}});
    const std::vector<int> pins(both.pins.begin() + 7, both.pins.end());
    settings.effects.add(MovingPins{.pins = pins, .keyframes = {{.time = 1, .value = {0, 0, -depth}}}});
    Simulation simulation(settings);
    run(simulation, 40);
    return Vertices(simulation.state().x.topRows(n));
  };
  EXPECT_LT((moved_to(5) - moved_to(0)).cwiseAbs().maxCoeff(), GetParam().is_explicit() ? 1e-12 : 1e-4);
}

TEST(SeveralCloths, AnEffectActsOnItsClothOnly) {
  const Cloth strip = [] {
    Cloth cloth = panel(8, 2, {0.4, 0.1}, {0, 0, 0});
    cloth.pins = {0, 1, 9, 10, 18, 19};
    return cloth;
  }();
  const Cloth two = joined({strip, moved(strip, {0, 1, 0})});
  const NamedMethod method{Method::implicit, "Implicit"};
  Simulation both(
      exactly(two, method, 0.01,
              {Gravity{}, Bending{.rigidity = 1e-3, .cloth = "b"}, StrainLimit{.max_stretch = 1.01, .cloth = "a"}}));
  Simulation bent(exactly(strip, method, 0.01, {Gravity{}, Bending{.rigidity = 1e-3}}));
  Simulation limited(exactly(strip, method, 0.01, {Gravity{}, StrainLimit{.max_stretch = 1.01}}));
  for (Simulation* one : {&both, &bent, &limited}) run(*one, 20);
  const Eigen::Index n = strip.positions.rows();
  EXPECT_LT((both.state().x.topRows(n) - limited.state().x).cwiseAbs().maxCoeff(), 1e-4);
  EXPECT_LT(((both.state().x.bottomRows(n).rowwise() - RowVector3d(0, 1, 0)) - bent.state().x).cwiseAbs().maxCoeff(),
            1e-5);
  EXPECT_GT((bent.state().x - limited.state().x).cwiseAbs().maxCoeff(), 0.01);
}

TEST(SeveralCloths, LimitsOfEachClothHoldTogether) {
  Cloth hung = panel(4, 4, {0.4, 0.4}, {0, 0, 0});
  stiffen_by_area(1, hung);
  hung.pins = {20, 24};
  Simulation simulation(exactly(
      joined({hung, moved(hung, {1, 0, 0})}), explicit_methods[1], 0.01,
      {Gravity{}, StrainLimit{.max_stretch = 1.02, .cloth = "a"}, StrainLimit{.max_stretch = 1.1, .cloth = "b"}}));
  run(simulation, 60);
  std::array<double, 2> most{};
  for (const Spring& s : simulation.cloth().springs) {
    double& longest = most[s.i < hung.vertex_count() ? 0U : 1U];
    longest = std::max(longest, (simulation.state().x.row(s.i) - simulation.state().x.row(s.j)).norm() / s.rest_length);
  }
  EXPECT_NEAR(most[0], 1.02, 0.002);
  EXPECT_NEAR(most[1], 1.1, 0.002);
}

TEST(SeveralCloths, EnergiesOfTheClothsAddUp) {
  const Cloth two = disturbed(joined({grid_cloth(4), moved(grid_cloth(3), {0, 0, 1})}));
  Simulation simulation(
      exactly(two, explicit_methods[1], 0.001, {Gravity{}, Bending{.rigidity = 1e-2, .cross_stiffness = 3.0}}));
  run(simulation, 10);
  const Energies all = simulation.energies();
  const std::vector<Energies> each = simulation.piece_energies();
  ASSERT_EQ(each.size(), 2U);
  EXPECT_NEAR(each[0].kinetic + each[1].kinetic, all.kinetic, 1e-12 * all.kinetic);
  EXPECT_NEAR(each[0].gravity + each[1].gravity, all.gravity, 1e-12 * std::abs(all.gravity) + 1e-12);
  EXPECT_NEAR(each[0].elastic + each[1].elastic, all.elastic, 1e-12 * all.elastic);
  EXPECT_GT(each[1].elastic, 0);
}

class Touching : public testing::TestWithParam<NamedMethod> {};
INSTANTIATE_TEST_SUITE_P(SeveralCloths, Touching, testing::ValuesIn(sewing_methods), method_name);

TEST_P(Touching, ClothsThatCollideKeepTheirMomentum) {
  Cloth above = panel(5, 5, {0.3, 0.3}, {0.06, 0.05, 0.05});
  above.velocities.col(2).setConstant(-1);
  above.velocities.col(0).setConstant(0.2);
  const Cloth two = joined({panel(6, 4, {0.4, 0.4}, {0, 0, 0}), above});
  Simulation simulation(exactly(two, GetParam(), 0.01, {SelfCollision{.thickness = 0.01}}));
  const RowVector3d before = momentum_of(two, two.velocities);
  run(simulation, 20);
  EXPECT_LT((momentum_of(two, simulation.state().v) - before).norm(), 1e-11);
  EXPECT_LT(simulation.state().v.topRows(35).col(2).mean(), -0.1);  // the lower one was struck
}

TEST_P(Touching, APairHasItsOwnFriction) {
  constexpr double friction = 0.4, speed = 0.6;
  Cloth table = panel(12, 4, {1.2, 0.4}, {0, 0, 0});
  table.pins = every(table.vertex_count());
  Cloth napkin = panel(3, 3, {0.15, 0.15}, {0.2, 0.12, 0.0101});
  napkin.velocities.col(0).setConstant(speed);
  const auto slide = [&](const std::vector<ClothFriction>& contact) {
    Simulation simulation(exactly(joined({table, napkin}), GetParam(), 0.005,
                                  {Gravity{}, SelfCollision{.thickness = 0.01, .friction = 0, .contact = contact}}));
    run(simulation, 20);
    return simulation.state().v.bottomRows(napkin.vertex_count()).col(0).mean();
  };
  const double time = 20 * 0.005;
  EXPECT_NEAR(slide({}), speed, 0.01 * speed);
  EXPECT_NEAR(slide({ClothFriction{.cloths = {"b", "a"}, .friction = friction}}), speed - friction * g * time,
              0.06 * speed);
  EXPECT_NEAR(slide({ClothFriction{.cloths = {"b", "b"}, .friction = friction}}), speed, 0.01 * speed);
}

}  // namespace
}  // namespace drape::test
