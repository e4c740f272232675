// A cloth that hangs on a skinned arm, from a file that somebody else has made.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "scene/mesh_file.hpp"
#include "sim/collision/placed_mesh.hpp"
#include "sim/effects/body.hpp"
#include "sim/effects/moving_pins.hpp"
#include "sim/simulation.hpp"
#include "tests/support/setups.hpp"

namespace drape::test {
namespace {

const std::filesystem::path arm_file = DRAPE_SOURCE_DIR "/../shared/reference/real/arm_with_cloth.usda";

/// The way of the vertex that is where the cloth's is when the motion begins.
std::vector<Keyframe> way_of(const MeshMotion& motion, const Eigen::RowVector3d& start) {
  Eigen::Index nearest = 0;
  (motion.samples.front().rowwise() - start).rowwise().squaredNorm().minCoeff(&nearest);
  std::vector<Keyframe> way;
  for (std::size_t k = 0; k < motion.times.size(); ++k) {
    way.push_back({motion.times[k], motion.samples[k].row(nearest).transpose()});
  }
  return way;
}

TEST(Arm, AClothThatHangsOnItStaysOutOfIt) {
  if (!std::filesystem::exists(arm_file)) GTEST_SKIP() << arm_file << " is not here";
  const auto arm = std::make_shared<MeshMotion>(read_mesh_motion(arm_file, {.prim = "/root/Model/Mesh/Mesh"}));
  ASSERT_GT(arm->samples.size(), 1U) << "it moves";
  const Mesh sheet = read_mesh(arm_file, {.prim = "/root/Grid/Grid"});
  constexpr double thickness = 0.05;
  const std::vector<int> pins{21, 23};  // at the corners of the arm's top
  for (const Method method : {Method::quasi_newton, Method::liu13}) {
    SimulationSettings s = setup(make_cloth(sheet, sheet, 1, 100, pins), {method}, 0.01);
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
    // It has been taken along: where the arm has gone is not where the cloth began.
    EXPECT_GT((simulation.state().x - sheet.positions).rowwise().norm().minCoeff(), 0.1);
  }
}

}  // namespace
}  // namespace drape::test
