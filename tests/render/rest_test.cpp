#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <numbers>
#include <vector>

#include "tests/render/drawing.hpp"
#include "tests/support/random.hpp"

namespace drape::test {
namespace {

/// Makes three layers on a ground, at the distance kept by self-collision.
Mesh pile() {
  const Mesh layer = make_grid(12, 12);
  const auto n = layer.positions.rows();
  Mesh mesh;
  mesh.positions.resize(3 * n, 3);
  for (int k = 0; k < 3; ++k) {
    mesh.positions.middleRows(k * n, n) =
        (layer.positions * (1 - 0.2 * k)).rowwise() + Eigen::RowVector3d(0.05 * k, 0.1 * k, 0.01 + 0.01 * k);
    const int first = static_cast<int>(k * n);
    for (const Triangle& t : layer.triangles) mesh.triangles.push_back({first + t[0], first + t[1], first + t[2]});
    mesh.uvs.insert(mesh.uvs.end(), layer.uvs.begin(), layer.uvs.end());
  }
  return mesh;
}

int flipped_pixels(const Image& one, const Image& other) {
  int count = 0;
  for (std::size_t i = 0; i < one.pixels.size(); i += 3) {
    int most = 0;
    for (std::size_t c = 0; c < 3; ++c) most = std::max(most, std::abs(one.pixels[i + c] - other.pixels[i + c]));
    count += most > 6 ? 1 : 0;
  }
  return count;
}

// A resting cloth still moves by the solver's error: a ten-millionth of a metre. From any distance, at equal apparent
// size, no pixel flips to another layer or into a shadow.
TEST(Rest, NoPixelOfLayersThatTouchFlickersAtAnyDistance) {
  const Mesh mesh = pile();
  const std::vector<Collider> ground{GroundShape{{0, 0, 1}, 0, 0.01}};
  for (const double distance : {4.0, 40.0, 400.0, 1500.0}) {
    const Eigen::Vector3d direction = Eigen::Vector3d(0.7, -1.2, 0.6).normalized();
    const View view{distance * direction, {0, 0, 0}, {0, 0, 1}, 2 * std::atan(1.2 / distance) * 180 / std::numbers::pi};
    Look look;
    look.texture = data_folder() / "textures/plaid.png";
    Renderer renderer(data_folder(), {240, 200}, view, look, static_cast<int>(mesh.positions.rows()), mesh.triangles,
                      mesh.uvs);
    Random random(11);
    Frame frame;
    frame.colliders = ground;
    frame.positions = mesh.positions;
    const Image first = renderer.draw(frame);
    for (int k = 0; k < 6; ++k) {
      for (double& coordinate : frame.positions.reshaped()) coordinate += random.between(-1e-7, 1e-7);
      EXPECT_EQ(flipped_pixels(renderer.draw(frame), first), 0) << "from " << distance << " m, frame " << k;
    }
  }
}

TEST(Rest, TheTopmostLayerIsSeenFromAnyDistance) {
  const Mesh mesh = pile();
  const auto layer = static_cast<std::size_t>(mesh.positions.rows()) / 3;
  std::vector<Rgb> colors(3 * layer, Rgb{0, 0, 1});
  std::fill(colors.begin() + static_cast<std::ptrdiff_t>(2 * layer), colors.end(), Rgb{1, 0, 0});
  Frame frame;
  frame.positions = mesh.positions;
  frame.colliders = {GroundShape{{0, 0, 1}, 0, 0.01}};
  Look look;
  look.shadows = false;  // with shadows, shadowed parts are drawn last, so lower layers could not show through
  for (const double distance : {4.0, 40.0, 400.0, 3000.0}) {
    const View view{{0, 0, distance}, {0, 0, 0}, {0, 1, 0}, 2 * std::atan(1.2 / distance) * 180 / std::numbers::pi};
    const Image image = Renderer(data_folder(), {200, 200}, view, look, static_cast<int>(mesh.positions.rows()),
                                 mesh.triangles, mesh.uvs)
                            .draw(frame, colors);
    int others = 0;
    for (int y = 50; y < 110; ++y) {  // -0.36 to 0.36 m, and 0.6 to -0.12 m
      for (int x = 70; x < 130; ++x) others += image.at(x, y)[0] > image.at(x, y)[2] + 30 ? 0 : 1;
    }
    EXPECT_EQ(others, 0) << "from " << distance << " m";
  }
}

}  // namespace
}  // namespace drape::test
