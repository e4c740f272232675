#include "import/mesh_frame.hpp"

#include <fmt/format.h>

#include <cmath>

#include "import/motion_source.hpp"
#include "scene/mesh/builder.hpp"

namespace drape {

void add_faces(const std::string& name, const std::vector<std::size_t>& sizes, const std::vector<double>& corners,
               Mesh& mesh) {
  std::vector<int> vertices;
  std::vector<Eigen::Vector3d> places;
  std::size_t first = 0;
  for (const std::size_t size : sizes) {
    if (size < 3) fail_import(name, fmt::format("a face needs at least 3 corners, found {}", size));
    if (corners.size() - first < size) fail_import(name, "the list of faces is cut short");
    vertices.clear();
    for (std::size_t i = first; i < first + size; ++i) {
      if (!(corners[i] >= 0 && corners[i] < static_cast<double>(mesh.positions.rows()))) {
        fail_import(name, fmt::format("a face names vertex {}, but there are {}, numbered from 0", corners[i],
                                      mesh.positions.rows()));
      }
      vertices.push_back(static_cast<int>(corners[i]));
    }
    first += size;
    if (size == 3) {
      mesh.triangles.push_back({vertices[0], vertices[1], vertices[2]});
      continue;
    }
    if (size > most_concave_corners) fail_import(name, fmt::format("a face has {} corners: triangulate it", size));
    places.clear();
    for (const int v : vertices) places.emplace_back(mesh.positions.row(v).transpose());
    for (const auto& [a, b, c] : triangulate(places)) {
      mesh.triangles.push_back({vertices[a], vertices[b], vertices[c]});
    }
  }
}

Vertices vertices_of(const std::string& name, const std::vector<double>& numbers) {
  if (numbers.size() % 3 != 0) {
    fail_import(name, fmt::format("expected three numbers for each vertex, found {} numbers", numbers.size()));
  }
  Vertices x(static_cast<Eigen::Index>(numbers.size() / 3), 3);
  for (Eigen::Index v = 0; v < x.rows(); ++v) {
    for (Eigen::Index axis = 0; axis < 3; ++axis) x(v, axis) = numbers[static_cast<std::size_t>(3 * v + axis)];
  }
  return x;
}

}  // namespace drape
