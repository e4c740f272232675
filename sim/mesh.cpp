#include "drape/sim/mesh.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <stdexcept>

#include "sim/bending/bending_energy.hpp"

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

namespace {

constexpr double cosine_of_150_degrees = -0.86602540378443865;

Eigen::Vector3d unit_normal(const Triangle& t, const Vertices& x) {
  const Eigen::Vector3d a = x.row(t[0]), b = x.row(t[1]), c = x.row(t[2]);
  return (b - a).cross(c - a).normalized();  // stays zero without area
}

}  // namespace

FlippedPairs::FlippedPairs(const std::vector<Triangle>& triangles) : triangles_(triangles) {
  const std::vector<EdgeSide> sides = edge_sides(triangles);
  for (std::size_t s = 1; s < sides.size(); ++s) {
    if (sides[s].edge == sides[s - 1].edge) neighbours_.push_back({sides[s - 1].triangle, sides[s].triangle});
  }
}

int FlippedPairs::count(const Vertices& x) const {
  std::vector<Eigen::Vector3d> normals;
  normals.reserve(triangles_.size());
  for (const Triangle& triangle : triangles_) normals.push_back(unit_normal(triangle, x));
  return static_cast<int>(std::count_if(neighbours_.begin(), neighbours_.end(), [&](const std::array<int, 2>& pair) {
    return normals[static_cast<std::size_t>(pair[0])].dot(normals[static_cast<std::size_t>(pair[1])]) <
           cosine_of_150_degrees;
  }));
}

namespace {

using Edges = Eigen::Matrix<double, 3, 2>;

/// Returns the edges from a triangle's first vertex to its second and third.
Edges edges_of(const Vertices& x, const Triangle& t) {
  Edges edges;
  edges << (x.row(t[1]) - x.row(t[0])).transpose(), (x.row(t[2]) - x.row(t[0])).transpose();
  return edges;
}

/// Returns the larger singular value, from the closed form of the eigenvalues of FᵀF.
double largest_singular_value(const Edges& f) {
  const double a = f.col(0).squaredNorm(), b = f.col(0).dot(f.col(1)), d = f.col(1).squaredNorm();
  return std::sqrt((a + d) / 2 + std::hypot((a - d) / 2, b));
}

}  // namespace

VertexStretch::VertexStretch(const Vertices& rest, const std::vector<Triangle>& triangles)
    : areas_(Eigen::VectorXd::Zero(rest.rows())) {
  for (const Triangle& triangle : triangles) {
    const Edges edges = edges_of(rest, triangle);
    const double area = edges.col(0).cross(edges.col(1)).norm() / 2;
    if (!(area > 0)) continue;
    // Place the triangle in its own plane, with its first edge along x.
    const Eigen::Vector3d x = edges.col(0).normalized();
    Eigen::Matrix2d flat;
    flat << edges.col(0).norm(), x.dot(edges.col(1)), 0, 2 * area / edges.col(0).norm();
    elements_.push_back({triangle, flat.inverse(), area});
    for (const int vertex : triangle) areas_[vertex] += area;
  }
}

Eigen::VectorXd VertexStretch::operator()(const Vertices& positions) const {
  Eigen::VectorXd stretch = Eigen::VectorXd::Zero(areas_.size());
  for (const Element& element : elements_) {
    const double largest = largest_singular_value(edges_of(positions, element.triangle) * element.to_rest);
    for (const int vertex : element.triangle) stretch[vertex] += element.area * largest;
  }
  return (areas_.array() > 0).select(stretch.array() / areas_.array().max(1e-300), 1.0);
}

namespace {

/// A triangle at an edge.
struct Side {
  int triangle;
  bool forwards;  // true if it runs along the edge from the smaller vertex number to the larger
};

}  // namespace

double mean_edge(const Vertices& x, const std::vector<Triangle>& triangles) {
  double sum = 0;
  for (const Triangle& t : triangles) {
    for (std::size_t c = 0; c < 3; ++c) sum += (x.row(t[c]) - x.row(t[(c + 1) % 3])).norm();
  }
  return triangles.empty() ? 0 : sum / (3 * static_cast<double>(triangles.size()));
}

VertexCurvature::VertexCurvature(int vertex_count, const std::vector<Triangle>& triangles)
    : vertex_count_(vertex_count), triangles_(triangles) {
  std::map<Edge, std::vector<Side>> edges;  // sorted by vertices, for a fixed order of sums
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (std::size_t c = 0; c < 3; ++c) {
      const int p = triangles[t][c], q = triangles[t][(c + 1) % 3];
      if (p != q) edges[{std::min(p, q), std::max(p, q)}].push_back({static_cast<int>(t), p < q});
    }
  }
  for (const auto& [edge, sides] : edges) {
    if (sides.size() != 2) continue;
    const bool alike = sides[0].forwards != sides[1].forwards;
    hinges_.push_back({edge, {sides[0].triangle, sides[1].triangle}, alike ? 1.0 : -1.0});
  }
}

Eigen::VectorXd VertexCurvature::operator()(const Vertices& positions) const {
  Eigen::VectorXd area = Eigen::VectorXd::Zero(vertex_count_), bent = area;
  Vertices normals(static_cast<Eigen::Index>(triangles_.size()), 3);  // with the length of twice the triangles' areas
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    const auto& [a, b, c] = triangles_[t];
    const Eigen::Vector3d ab = positions.row(b) - positions.row(a), ac = positions.row(c) - positions.row(a);
    const Eigen::Vector3d normal = ab.cross(ac);
    normals.row(static_cast<Eigen::Index>(t)) = normal.transpose();
    for (const int vertex : triangles_[t]) area[vertex] += normal.norm() / 6;
  }
  for (const Hinge& hinge : hinges_) {
    const Eigen::Vector3d first = normals.row(hinge.triangles[0]),
                          second = hinge.turned * normals.row(hinge.triangles[1]);
    const double angle = std::atan2(first.cross(second).norm(), first.dot(second));
    const double length = (positions.row(hinge.edge[1]) - positions.row(hinge.edge[0])).norm();
    for (const int vertex : hinge.edge) bent[vertex] += angle * length / 4;
  }
  return (area.array() > 0).select(bent.array() / area.array().max(1e-300), 0.0);
}

}  // namespace drape
