#include <gtest/gtest.h>

#include <variant>

#include "drape/sim/effects/acceleration.hpp"
#include "drape/sim/simulation.hpp"
#include "tests/support/setups.hpp"

namespace drape::test {
namespace {

class Effects : public testing::TestWithParam<NamedMethod> {};
INSTANTIATE_TEST_SUITE_P(With, Effects, testing::ValuesIn(all_methods), method_name);

using Eigen::RowVector3d;
using Eigen::Vector3d;

/// Makes vertices without springs: each moves by its own forces.
Cloth loose_vertices(const Vertices& positions) {
  Cloth cloth;
  cloth.positions = positions;
  cloth.velocities = Vertices::Zero(positions.rows(), 3);
  cloth.masses = Eigen::VectorXd::LinSpaced(positions.rows(), 0.5, 2);
  return cloth;
}

/// Returns each vertex's acceleration in the first step, n×3.
Vertices first_accelerations(const SimulationSettings& settings) {
  Simulation simulation(settings);
  simulation.step();
  return (simulation.state().v - settings.cloth.velocities) / settings.step;
}

TEST_P(Effects, GravityIsNineEightDownwardsUnlessGiven) {
  SimulationSettings settings = setup(loose_vertices(random_vertices(5, 1)), GetParam(), 0.01);
  settings.effects = {Gravity{}};
  Vertices expected = RowVector3d(0, 0, -9.8).replicate(5, 1);
  EXPECT_LT((first_accelerations(settings) - expected).cwiseAbs().maxCoeff(), 1e-11);
  settings.effects = {Gravity{.acceleration = {1, -2, 3}}};
  expected = RowVector3d(1, -2, 3).replicate(5, 1);
  EXPECT_LT((first_accelerations(settings) - expected).cwiseAbs().maxCoeff(), 1e-11);
}

TEST_P(Effects, WindAcceleratesEveryVertexAlikeAndIsNoGravity) {
  SimulationSettings settings = setup(loose_vertices(random_vertices(5, 1)), GetParam(), 0.01);
  settings.effects = {Wind{.acceleration = {1, -2, 3}}};
  const Vertices expected = RowVector3d(1, -2, 3).replicate(5, 1);
  EXPECT_LT((first_accelerations(settings) - expected).cwiseAbs().maxCoeff(), 1e-11);
  EXPECT_EQ(Simulation(settings).energies().gravity, 0);
}

TEST_P(Effects, WithoutAnyALooseVertexGoesStraightOn) {
  SimulationSettings settings = setup(loose_vertices(random_vertices(3, 1)), GetParam(), 0.01);
  settings.cloth.velocities = RowVector3d(2, -1, 0.5).replicate(3, 1);
  Simulation simulation(settings);
  for (int step = 0; step < 10; ++step) simulation.step();
  const Vertices expected = settings.cloth.positions + 0.1 * settings.cloth.velocities;
  EXPECT_LT((simulation.state().x - expected).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_LT((simulation.state().v - settings.cloth.velocities).cwiseAbs().maxCoeff(), 1e-11);
}

// a = k·max(s·r − ‖x−c‖, 0)·(x−c)/‖x−c‖
TEST_P(Effects, SpherePushesOutwardsWithinItsReach) {
  Vertices x(6, 3);
  x << 1.3, 2, 3,      // 0.3 from the centre in x: inside
      1, 2, 3.52,      // between the radius and the reach
      1, 2 - 0.55, 3,  // on the reach
      5, 2, 3,         // outside
      1, 2, 3,         // the centre itself, without an outward direction
      1.03, 2.04, 3;   // 0.05 away, in the direction (0.6, 0.8, 0)
  SimulationSettings settings = setup(loose_vertices(x), GetParam(), 0.01);
  settings.effects = {Sphere{.center = Vector3d(1, 2, 3), .radius = 0.5, .scale = 1.1, .stiffness = 1000}};
  Vertices expected = Vertices::Zero(6, 3);
  expected(0, 0) = 1000 * 0.25;
  expected(1, 2) = 1000 * 0.03;
  expected.row(5) = 1000 * 0.5 * RowVector3d(0.6, 0.8, 0);
  EXPECT_LT((first_accelerations(settings) - expected).cwiseAbs().maxCoeff(), 1e-9);
}

TEST_P(Effects, TwoSpheresPushTogetherAndAreBothDrawn) {
  SimulationSettings settings = setup(loose_vertices(RowVector3d(0, 0, 0)), GetParam(), 0.01);
  settings.effects = {Sphere{.center = Vector3d(-1, 0, 0), .radius = 1, .scale = 1.2, .stiffness = 100},
                      Sphere{.center = Vector3d(0, 0, -0.5), .radius = 0.6, .scale = 1, .stiffness = 50}};
  const RowVector3d expected(100 * 0.2, 0, 50 * 0.1);
  EXPECT_LT((first_accelerations(settings) - expected).cwiseAbs().maxCoeff(), 1e-10);

  const auto colliders = Simulation(settings).colliders(3);
  ASSERT_EQ(colliders.size(), 2U);
  EXPECT_EQ(std::get<SphereShape>(colliders[0]).center, Vector3d(-1, 0, 0));
  EXPECT_EQ(std::get<SphereShape>(colliders[0]).radius, 1);
  EXPECT_EQ(std::get<SphereShape>(colliders[1]).center, Vector3d(0, 0, -0.5));
  EXPECT_EQ(std::get<SphereShape>(colliders[1]).radius, 0.6);
}

TEST_P(Effects, SphereReportsAnUnstablePenalty) {
  const auto with_stiffness = [](double stiffness) {
    return Sphere{.center = Vector3d(0, 0, 0), .radius = 1, .stiffness = stiffness};
  };
  SimulationSettings settings = setup(loose_vertices(RowVector3d(0, 0, 0)), GetParam(), 0.02);
  EXPECT_TRUE(problems(with_stiffness(8000), settings).empty());
  EXPECT_TRUE(problems(with_stiffness(10000), settings).empty()) << "2 itself is allowed";
  EXPECT_EQ(problems(with_stiffness(10010), settings).size(), 1U);
  settings.step = 0.025;
  const auto found = problems(with_stiffness(8000), settings);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_TRUE(found[0].starts_with("stiffness: ")) << found[0];
  EXPECT_NE(found[0].find("6400"), std::string::npos) << "names the largest stiffness: " << found[0];
}

TEST(EffectTypes, HaveDistinctNamesAndMakeEffects) {
  const auto types = effect_types();
  for (std::size_t i = 0; i < types.size(); ++i) {
    EXPECT_EQ(types[i].make().name(), types[i].name);
    for (std::size_t j = 0; j < i; ++j) EXPECT_NE(types[i].name, types[j].name);
  }
}

std::vector<std::string_view> names(const drape::Effects& effects) {
  std::vector<std::string_view> all;
  for (const Effect& effect : effects) all.push_back(effect.name());
  return all;
}

TEST(EffectValues, AreEvaluatedInTheOrderOfTheRegistryHoweverTheyAreAdded) {
  drape::Effects effects{Damping{.factor = 0.5}, Sphere{.radius = 1}, Gravity{}, Sphere{.radius = 2}};
  effects.add(Wind{});
  EXPECT_EQ(names(effects), (std::vector<std::string_view>{"gravity", "wind", "sphere", "sphere", "damping"}));
  EXPECT_EQ(effects[2].as<Sphere>()->radius, 1) << "of one type in the order in which they are added";
}

/// An effect of a type outside the registry.
struct Push {
  static constexpr std::string_view name = "push";
  void describe(Keys&) {}
  void install(System&) const {}
};

TEST(EffectValues, OfATypeThatIsNotInTheRegistryStayWhereTheyAreAdded) {
  const drape::Effects effects{Sphere{}, Push{}, Damping{}, Wind{}};
  EXPECT_EQ(names(effects), (std::vector<std::string_view>{"sphere", "push", "wind", "damping"}));
}

TEST(EffectValues, AreCopiedAsWhatTheyAre) {
  Effect gravity = Gravity{.acceleration = {0, 0, -1}};
  const Effect copy = gravity;
  gravity = Damping{.factor = 0.5};
  EXPECT_EQ(gravity.name(), "damping");
  ASSERT_NE(copy.as<Gravity>(), nullptr);
  EXPECT_EQ(copy.as<Gravity>()->acceleration, Vector3d(0, 0, -1));
  EXPECT_EQ(copy.as<Damping>(), nullptr);
}

}  // namespace
}  // namespace drape::test
