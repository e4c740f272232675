#include "sim/mesh.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <stdexcept>

namespace drape {

Mesh make_grid(int columns, int rows) {
  if (columns < 1 || rows < 1) throw std::invalid_argument("a grid needs at least 1×1 cells");
  const std::int64_t count = (std::int64_t{columns} + 1) * (std::int64_t{rows} + 1);
  if (count > std::numeric_limits<int>::max() / 6) throw std::invalid_argument("a grid this large cannot be numbered");

  Mesh mesh;
  mesh.positions.resize(count, 3);
  for (int j = 0, vertex = 0; j <= rows; ++j) {
    for (int i = 0; i <= columns; ++i, ++vertex) {
      mesh.positions.row(vertex) << -1.0 + 2.0 * i / columns, -1.0 + 2.0 * j / rows, 0.0;
    }
  }

  const int stride = columns + 1;
  const auto cells = static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
  mesh.triangles.resize(2 * cells);
  for (int j = 0, cell = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i, ++cell) {
      const int a = j * stride + i, b = a + 1, d = a + stride, e = d + 1;
      mesh.triangles[static_cast<std::size_t>(cell)] = {b, d, a};
      mesh.triangles[cells + static_cast<std::size_t>(cell)] = {b, e, d};
    }
  }

  mesh.uvs.reserve(3 * mesh.triangles.size());
  for (const Triangle& triangle : mesh.triangles) {
    for (const int vertex : triangle) {
      mesh.uvs.push_back({static_cast<float>((mesh.positions(vertex, 0) + 1) / 2),
                          static_cast<float>((mesh.positions(vertex, 1) + 1) / 2)});
    }
  }
  return mesh;
}

std::vector<Edge> unique_edges(const std::vector<Triangle>& triangles) {
  std::vector<Edge> edges;
  edges.reserve(3 * triangles.size());
  for (const Triangle& t : triangles) {
    for (std::size_t c = 0; c < 3; ++c) {
      const int p = t[c], q = t[(c + 1) % 3];
      if (p != q) edges.push_back({std::min(p, q), std::max(p, q)});
    }
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

}  // namespace drape
