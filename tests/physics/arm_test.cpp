// Cloth pinned to bodies: to the corners of a box, and to a skinned arm from a file of another author.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <tuple>

#include "drape/sim/effects/body.hpp"
#include "drape/sim/effects/moving_pins.hpp"
#include "drape/sim/simulation.hpp"
#include "scene/mesh_value.hpp"
#include "sim/collision/placed_mesh.hpp"
#include "tests/support/setups.hpp"

namespace drape::test {
namespace {

const std::filesystem::path arm_file = DRAPE_SOURCE_DIR "/../shared/reference/real/arm_with_cloth.usda";

/// Returns the path of the mesh vertex at the cloth vertex's initial position.
std::vector<Keyframe> way_of(const MeshMotion& motion, const Eigen::RowVector3d& start) {
  Eigen::Index nearest = 0;
  (motion.samples.front().rowwise() - start).rowwise().squaredNorm().minCoeff(&nearest);
  std::vector<Keyframe> way;
  for (std::size_t k = 0; k < motion.times.size(); ++k) {
    way.push_back({motion.times[k], motion.samples[k].row(nearest).transpose()});
  }
  return way;
}

class PinnedToABody : public testing::TestWithParam<NamedMethod> {};
INSTANTIATE_TEST_SUITE_P(With, PinnedToABody, testing::ValuesIn(all_methods), method_name);

// A part lies on the box, and the rest hangs in front. Pins and box touch permanently: the cloth's edges near a pin are
// near the box's edges too.
TEST_P(PinnedToABody, AClothIsNotThrown) {
  constexpr double side = 1, drop = 0.75;  // length that hangs, and a little more
  Mesh sheet = make_grid(4, 4);
  sheet.positions *= side / 2;
  SimulationSettings s = setup(cloth_of(sheet, 0.2, 200, {16, 18}), GetParam(), 0.004);
  s.integrator.tolerance = 1e-7;
  s.integrator.max_iterations = 500;
  s.effects = {
      Gravity{},
      Body{.box = Eigen::Vector3d::Constant(0.5), .center = Eigen::Vector3d(0, 0.5, -0.25), .thickness = 0.02}};
  Simulation simulation(s);
  for (int step = 0; step < 200; ++step) {
    simulation.step();
    // The speed limit is that of free fall so far, doubled for energy that springs transfer.
    ASSERT_LT(simulation.state().v.rowwise().norm().maxCoeff(), 2 * std::sqrt(2 * 9.8 * drop)) << "step " << step;
  }
  EXPECT_LT(simulation.state().x.rowwise().norm().maxCoeff(), 1.5 * side);
}

TEST(Arm, AClothThatHangsOnItStaysOutOfIt) {
  if (!std::filesystem::exists(arm_file)) GTEST_SKIP() << arm_file << " is not here";
  const auto arm = std::make_shared<MeshMotion>(read_mesh_motion(arm_file, {.prim = "/root/Model/Mesh/Mesh"}));
  ASSERT_GT(arm->samples.size(), 1U) << "it moves";
  const Mesh sheet = read_mesh(arm_file, {.prim = "/root/Grid/Grid"});
  const std::vector<int> pins{21, 23};  // at the corners of the arm's top
  for (const auto& [method, stiffness, thickness] : {std::tuple{Method::quasi_newton, 100.0, 0.05},
                                                     {Method::liu13, 100.0, 0.05},
                                                     {Method::quasi_newton, 200.0, 0.02}}) {
    SimulationSettings s = setup(make_cloth(sheet, sheet, 1, stiffness, pins), {method}, 0.01);
    s.effects = {Gravity{}, Damping{.factor = 0.5}, Body{.mesh = arm, .thickness = thickness}};
    for (const int pin : pins) {
      s.effects.add(MovingPins{
          .pins = {pin}, .keyframes = way_of(*arm, sheet.positions.row(pin)), .path = MovingPins::Path::position});
    }
    Simulation simulation(s);
    const auto topology =
        std::make_shared<MeshTopology>(arm->mesh.triangles, static_cast<int>(arm->mesh.positions.rows()));
    ASSERT_TRUE(topology->closed);
    for (int step = 1; step <= 200; ++step) {
      simulation.step();
      const auto body = std::get<MeshShape>(simulation.colliders(simulation.time()).at(0));
      const PlacedMesh placed(topology, body.positions);
      for (int i = 0; i < simulation.cloth().vertex_count(); ++i) {
        if (std::ranges::find(pins, i) != pins.end()) continue;
        const auto foot = placed.find(simulation.state().x.row(i).transpose(), thickness);
        if (foot) {
          ASSERT_GT(foot->distance, -thickness) << "vertex " << i << " after step " << step;
        }
      }
    }
    // The arm has carried it along, away from its start.
    EXPECT_GT((simulation.state().x - sheet.positions).rowwise().norm().minCoeff(), 0.1);
    EXPECT_LT(simulation.state().x.cwiseAbs().maxCoeff(), 4) << "thrown off";
  }
}

}  // namespace
}  // namespace drape::test
