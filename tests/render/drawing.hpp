#pragma once

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "drape/render/renderer.hpp"
#include "drape/sim/mesh.hpp"

namespace drape::test {

inline std::filesystem::path data_folder() { return DRAPE_SOURCE_DIR; }

/// Draws one frame of a mesh.
inline Image draw(const Mesh& mesh, const View& view, const Look& look, Eigen::Vector2i size = {120, 100},
                  const std::vector<Collider>& colliders = {}, GlBackend backend = GlBackend::automatic) {
  Renderer renderer(data_folder(), size, view, look, static_cast<int>(mesh.positions.rows()), mesh.triangles, mesh.uvs,
                    backend);
  Frame frame;
  frame.positions = mesh.positions;
  frame.colliders = colliders;
  return renderer.draw(frame);
}

/// Returns the view from +z onto the square [-1,1]², which fills the picture's height, with +y upwards.
inline View from_above() {
  return {{0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 2 * std::atan(1.0 / 5.0) * 180 / 3.14159265358979323846};
}

/// Makes a mesh that is outside all views of these tests.
inline Mesh nothing() {
  Mesh mesh;
  mesh.positions = Vertices::Constant(3, 3, 1000);
  mesh.triangles = {{0, 1, 2}};
  return mesh;
}

/// Converts sRGB to linear light by IEC 61966-2-1, independently of the tested code.
inline double to_linear(std::uint8_t byte) {
  const double value = byte / 255.0;
  return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

}  // namespace drape::test
