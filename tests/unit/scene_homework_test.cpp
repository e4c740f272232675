#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>

#include "drape/scene/scene.hpp"
#include "sim/system.hpp"

namespace drape {
namespace {

const std::filesystem::path homework_folder = std::filesystem::path(DRAPE_SOURCE_DIR) / "scenes" / "homework";

/// A row of the homework's table of animations.
struct Animation {
  std::string file;
  Method method;
  double step, stiffness;
  std::int64_t steps;
  bool textured;
  std::vector<std::string> effects;
};

class Homework : public ::testing::TestWithParam<Animation> {};

TEST_P(Homework, SceneIsWhatTheTableSays) {
  const Animation& expected = GetParam();
  const Scene scene = load_scene(homework_folder / (expected.file + ".toml"));
  EXPECT_EQ(scene.name, expected.file);
  EXPECT_EQ(scene.simulation.integrator.method, expected.method);
  if (expected.method != Method::semi_implicit) {
    EXPECT_EQ(scene.simulation.integrator.stop.value_or(StoppingRule::change), StoppingRule::change);
    EXPECT_EQ(scene.simulation.integrator.tolerance, 1e-3);
  }
  EXPECT_EQ(scene.simulation.step, expected.step);
  EXPECT_EQ(scene.step_count(), expected.steps);
  EXPECT_EQ(!scene.look.texture.empty(), expected.textured);

  const Cloth& cloth = scene.simulation.cloth;
  EXPECT_EQ(cloth.vertex_count(), 441);
  EXPECT_EQ(cloth.triangles.size(), 800U);
  EXPECT_EQ(cloth.springs.size(), 1240U);
  EXPECT_EQ(cloth.pins, (std::vector<int>{0, 20}));
  EXPECT_TRUE((cloth.masses.array() == 1.0 / 441).all());
  EXPECT_TRUE(cloth.velocities.isZero(0));
  for (const Spring& spring : cloth.springs) EXPECT_EQ(spring.stiffness, expected.stiffness);

  std::vector<std::string> effects;
  for (const Effect& effect : scene.simulation.effects) effects.emplace_back(effect.name());
  EXPECT_EQ(effects, expected.effects);
  EXPECT_EQ(scene.video.fps, 25);
  EXPECT_EQ(scene.video.size, Eigen::Vector2i(480, 400));
  EXPECT_FALSE(scene.look.background);
}

INSTANTIATE_TEST_SUITE_P(
    All, Homework,
    ::testing::Values(Animation{"1", Method::semi_implicit, 0.001, 18, 8334, false, {"gravity", "damping"}},
                      Animation{"2", Method::implicit, 0.02, 18, 417, true, {"gravity"}},
                      Animation{"3", Method::implicit, 0.02, 180, 417, true, {"gravity"}},
                      Animation{"4", Method::liu13, 0.02, 1800, 417, true, {"gravity"}},
                      Animation{"5", Method::liu13, 0.02, 180, 417, false, {"gravity", "sphere"}}),
    [](const auto& animation) { return "No" + animation.param.file; });

/// Effects of a scene on a cloth that moves at 1 m/s.
struct Acting {
  Scene scene;
  System system{scene.simulation.cloth, scene.simulation.step};

  explicit Acting(const std::string& file) : scene(load_scene(homework_folder / file)) {
    for (const Effect& effect : scene.simulation.effects) effect.install(system);
  }
};

TEST(Homework1, DampsVelocitiesToAFifthInASecond) {
  const Acting acting("1.toml");
  ASSERT_EQ(acting.system.corrections.size(), 1U);
  State state{.x = Vertices::Zero(1, 3), .v = Vertices::Ones(1, 3)};
  acting.system.corrections[0]->apply(state, 1);
  EXPECT_DOUBLE_EQ(state.v(0, 0), 0.2);
  EXPECT_EQ(acting.scene.video.speed, 2);
}

TEST(Homework5, HasTheSphereBelowTheCloth) {
  const Acting acting("5.toml");
  ASSERT_EQ(acting.system.colliders.size(), 1U);
  const auto sphere = std::get<SphereShape>(acting.system.colliders[0]->at(0));
  EXPECT_EQ(sphere.center, Eigen::Vector3d(0, 0, -0.5));
  EXPECT_EQ(sphere.radius, 0.4);

  // A vertex at the sphere's top is 0.04 m within 1.1 radii: 8000·0.04 = 320 m/s² upwards, less gravity.
  State state{.x = acting.scene.simulation.cloth.positions, .v = Vertices::Zero(441, 3)};
  state.x.row(220) << 0, 0, -0.1;
  Vertices force = Vertices::Zero(441, 3);
  for (const auto& f : acting.system.forces) f->add(state, 0, force);
  EXPECT_NEAR(force(220, 2) * 441, 320 - 9.8, 1e-9);
}

}  // namespace
}  // namespace drape
