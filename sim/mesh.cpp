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
  const auto each = [&](const auto& visit) {
    for (const Triangle& t : triangles) {
      for (std::size_t c = 0; c < 3; ++c) {
        const auto [low, high] = std::minmax({t[c], t[(c + 1) % 3]});
        if (low != high) visit(static_cast<std::size_t>(low), high);
      }
    }
  };
  // Bucket by the smaller vertex, so that few need sorting.
  std::size_t vertex_count = 0;
  each([&](std::size_t, int high) { vertex_count = std::max(vertex_count, static_cast<std::size_t>(high) + 1); });
  std::vector<std::size_t> next(vertex_count + 1, 0);
  each([&](std::size_t low, int) { ++next[low + 1]; });
  for (std::size_t v = 0; v < vertex_count; ++v) next[v + 1] += next[v];
  std::vector<int> others(next.back());
  each([&](std::size_t low, int high) { others[next[low]++] = high; });

  std::vector<Edge> edges;
  edges.reserve(others.size());
  auto begin = others.begin();
  for (std::size_t v = 0; v < vertex_count; ++v) {
    const auto end = others.begin() + static_cast<std::ptrdiff_t>(next[v]);
    std::sort(begin, end);
    std::for_each(begin, std::unique(begin, end), [&](int other) { edges.push_back({static_cast<int>(v), other}); });
    begin = end;
  }
  return edges;
}

}  // namespace drape
