#include "sim/grid.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>

namespace drape {
namespace {

Eigen::Vector2d size_of(const Grid& grid) {
  if (grid.size) return *grid.size;
  return {2, grid.pattern == GridPattern::equilateral ? std::sqrt(3.0) * grid.rows / grid.columns : 2};
}

/// Returns the vertices and triangles of rows of equilateral triangles in the square [-1,1]².
Mesh rows_of_triangles(int columns, int rows) {
  const auto row_begin = [&](int j) { return j * (columns + 1) + j / 2; };  // a shifted row has one more vertex
  Mesh mesh;
  mesh.positions.resize(row_begin(rows + 1), 3);
  for (int j = 0, vertex = 0; j <= rows; ++j) {
    for (; vertex < row_begin(j + 1); ++vertex) {
      const int i = vertex - row_begin(j);
      const double column = j % 2 == 0 ? i : std::min(std::max(i - 0.5, 0.0), 1.0 * columns);
      mesh.positions.row(vertex) << -1.0 + 2.0 * column / columns, -1.0 + 2.0 * j / rows, 0.0;
    }
  }
  for (int j = 0; j < rows; ++j) {
    const bool even = j % 2 == 0;  // the shifted row is the upper one
    const int straight = row_begin(even ? j : j + 1), moved = row_begin(even ? j + 1 : j);
    const auto add = [&](int a, int b, int c) {
      mesh.triangles.push_back(even ? Triangle{a, b, c} : Triangle{b, a, c});
    };
    for (int i = 0; i <= columns; ++i) {
      add(moved + i + 1, moved + i, straight + i);
      if (i < columns) add(straight + i, straight + i + 1, moved + i + 1);
    }
  }
  return mesh;
}

/// Divides the cells of a grid with one diagonal by another pattern.
void divide(GridPattern pattern, int columns, int rows, Mesh& mesh) {
  const bool crossed = pattern == GridPattern::x;
  const int corners = static_cast<int>(mesh.positions.rows());
  if (crossed) mesh.positions.conservativeResize(corners + columns * rows, 3);
  mesh.triangles.clear();
  for (int j = 0, cell = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i, ++cell) {
      const int a = j * (columns + 1) + i, b = a + 1, d = a + columns + 1, e = d + 1, middle = corners + cell;
      if (crossed) {
        mesh.positions.row(middle) << -1.0 + (2.0 * i + 1) / columns, -1.0 + (2.0 * j + 1) / rows, 0.0;
        mesh.triangles.insert(mesh.triangles.end(), {{a, b, middle}, {b, e, middle}, {e, d, middle}, {d, a, middle}});
      } else if ((i + j) % 2 == 0) {
        mesh.triangles.insert(mesh.triangles.end(), {{b, d, a}, {b, e, d}});
      } else {
        mesh.triangles.insert(mesh.triangles.end(), {{a, b, e}, {a, e, d}});
      }
    }
  }
}

}  // namespace

Mesh make_grid(const Grid& grid) {
  const Eigen::Vector2d size = size_of(grid);
  if (!(size.array() > 0).all() || !size.allFinite()) throw std::invalid_argument("a grid needs a positive size");
  const std::int64_t cells = std::int64_t{grid.columns} * grid.rows;
  if (cells > std::numeric_limits<int>::max() / 24) throw std::invalid_argument("a grid this large cannot be numbered");
  Mesh mesh = make_grid(grid.columns, grid.rows);
  if (grid.pattern == GridPattern::equilateral) mesh = rows_of_triangles(grid.columns, grid.rows);
  if (grid.pattern == GridPattern::alternating || grid.pattern == GridPattern::x) {
    divide(grid.pattern, grid.columns, grid.rows, mesh);
  }
  if (grid.pattern != GridPattern::diagonal) {
    mesh.uvs.clear();
    for (const Triangle& triangle : mesh.triangles) {
      for (const int vertex : triangle) {
        mesh.uvs.push_back({static_cast<float>((mesh.positions(vertex, 0) + 1) / 2),
                            static_cast<float>((mesh.positions(vertex, 1) + 1) / 2)});
      }
    }
  }
  mesh.positions.leftCols<2>() *= (size / 2).asDiagonal();
  return mesh;
}

}  // namespace drape
