#include <cstdio>
#include <drape/sim/effects/acceleration.hpp>
#include <drape/sim/effects/sphere.hpp>
#include <drape/sim/simulation.hpp>
#include <utility>

int main() {
  const drape::Mesh square = drape::make_grid(20, 20);
  drape::Simulation simulation({
      .cloth = drape::make_cloth(square, square, 1, 180, {0, 20}),
      .step = 0.02,
      .effects = {drape::Gravity{}, drape::Sphere{.center = Eigen::Vector3d(0, 0, -1), .radius = 0.4}},
  });
  for (int i = 0; i < 25; ++i) simulation.step();

  drape::Simulation moved = std::move(simulation);
  for (int i = 0; i < 25; ++i) moved.step();
  std::printf("%g s, lowest at %.3f m, state %016llx\n", moved.time(), moved.state().x.col(2).minCoeff(),
              static_cast<unsigned long long>(moved.hash()));
}
