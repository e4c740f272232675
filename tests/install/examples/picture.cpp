#include <cstdio>
#include <drape/render/renderer.hpp>

// Draws a cloth from above without a scene: the middle has the cloth's colour, the corner the background's.
int main() {
  const drape::Mesh mesh = drape::make_grid(4, 4);
  const drape::View view{.position = {0, 0, 8}, .target = {0, 0, 0}, .up = {0, 1, 0}};
  const drape::Look look{.color = {1, 0, 0}, .background = drape::Rgb{0, 0, 1}};
  drape::Renderer renderer(DRAPE_DATA, {64, 64}, view, look, 25, mesh.triangles, mesh.uvs);
  const drape::Image image = renderer.draw({.positions = mesh.positions});
  std::printf("middle %d %d, corner %d %d\n", image.at(32, 32)[0] > 64, image.at(32, 32)[2] > 64, image.at(0, 0)[0],
              image.at(0, 0)[2]);
}
