#pragma once

// Example:
//   drape::Mesh triangle;
//   triangle.positions.resize(3, 3);
//   triangle.positions << 0, 0, 0, 1, 0, 0, 0, 1, 0;  // a row for each vertex
//   triangle.triangles = {{0, 1, 2}};

// Example:
//   const drape::Mesh mesh = drape::make_grid({.columns = 30, .rows = 20, .size = {{1.5, 1}}});

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

namespace drape {

/// n×3, column-major: all x, then all y, then all z. Positions in m, velocities in m/s, forces in N.
using Vertices = Eigen::Matrix<double, Eigen::Dynamic, 3>;

/// Vertices of a triangle, counterclockwise seen from its front.
using Triangle = std::array<int, 3>;

/// Vertices of an edge, the smaller number first.
using Edge = std::array<int, 2>;

/// A triangle mesh. May have several pieces, boundary and non-manifold edges, and isolated vertices.
struct Mesh {
  Vertices positions = {};               ///< n×3 [m]
  std::vector<Triangle> triangles = {};  ///< indices below n
  /// Texture coordinates, v upwards: entry 3t+c is corner c of triangle t; empty if none.
  std::vector<std::array<float, 2>> uvs = {};
};

/// Returns the square [-1,1]² at z = 0 with columns×rows cells and (columns+1)·(rows+1) vertices in row-major order (x
/// fastest). Each cell has two triangles, (b,d,a) and (b,e,d) with a = (i,j), b = (i+1,j), d = (i,j+1), e = (i+1,j+1).
/// All (b,d,a) come first in row-major order, then all (b,e,d). Texture coordinates are ((x+1)/2, (y+1)/2).
/// @throws std::invalid_argument unless columns and rows are at least 1 and the vertices can be counted in an int
Mesh make_grid(int columns, int rows);

/// Returns every edge once, sorted. Degenerate sides (twice the same vertex) give no edge.
std::vector<Edge> unique_edges(const std::vector<Triangle>& triangles);

/// Division of a grid's cells into triangles.
enum class GridPattern {
  diagonal,     ///< one diagonal, the same in every cell
  alternating,  ///< one diagonal, alternating like the colours of a chessboard
  x,            ///< both diagonals, with a vertex in the middle
  equilateral   ///< rows of triangles, every other row shifted by half a cell
};

/// A rectangle of cells in the plane of x and y, around the origin.
struct Grid {
  int columns = 1, rows = 1;
  GridPattern pattern = GridPattern::diagonal;
  /// Size along x and y [m]. Default: 2 m × 2 m; for equilateral triangles 2 m × √3 rows/columns m.
  std::optional<Eigen::Vector2d> size = {};
};

/// Returns a grid. The corners of its cells come first, in row-major order (x fastest), then the middles of crossed
/// cells. A shifted row of equilateral triangles also has its two ends, so columns + 2 vertices. Diagonal grids of 2 m
/// × 2 m equal those of make_grid(columns, rows). Texture coordinates go from 0 to 1 along both sides.
/// @throws std::invalid_argument unless columns and rows are at least 1, the vertices can be counted in an int, and the
///   size is positive
Mesh make_grid(const Grid& grid);

/// Pairs of triangles that share an edge, to count pairs that fold over when steps are solved too loosely.
class FlippedPairs {
 public:
  explicit FlippedPairs(const std::vector<Triangle>& triangles);

  /// Returns the number of neighbours whose normals are more than 150° apart, folded back onto each other. Triangles
  /// without an area do not count.
  [[nodiscard]] int count(const Vertices& x) const;

 private:
  std::vector<Triangle> triangles_;
  std::vector<std::array<int, 2>> neighbours_;  // triangles, by shared edge
};

/// Stretch of a cloth at each vertex: the mean of the largest principal stretches of its triangles, weighted by rest
/// area. The largest principal stretch is the largest singular value of the deformation gradient F (1: at rest). A
/// cloth stretched by s in one direction only has s everywhere, on any mesh.
class VertexStretch {
 public:
  /// @param rest      n×3, unstrained shape [m]
  /// @param triangles of the cloth; those without a rest area are ignored
  VertexStretch(const Vertices& rest, const std::vector<Triangle>& triangles);

  /// Returns the stretch.
  /// @param positions n×3 [m]
  /// @returns n; 1 at vertices without a triangle
  [[nodiscard]] Eigen::VectorXd operator()(const Vertices& positions) const;

 private:
  struct Element {
    Triangle triangle;
    Eigen::Matrix2d to_rest;  // F = (edges in space)·to_rest
    double area;              // at rest [m²]
  };
  std::vector<Element> elements_;
  Eigen::VectorXd areas_;  // sum over the triangles around each vertex [m²]
};

/// Returns the mean length of the triangles' sides [m]; 0 without triangles.
double mean_edge(const Vertices& x, const std::vector<Triangle>& triangles);

/// Curvature of a cloth at each vertex [1/m]: (|κ₁| + |κ₂|)/2 of the principal curvatures. It is 1/(2R) on a cylinder
/// and 1/R on a sphere of radius R, and 0 in flat parts and at borders. An edge whose triangles meet at the angle θ
/// contributes ½θ times its length, shared by its two vertices. This is the integral of the mean curvature over a
/// rounded edge (Cohen-Steiner and Morvan 2003). A vertex's area is a third of its triangles' area.
class VertexCurvature {
 public:
  /// @param vertex_count of the cloth
  /// @param triangles    of the cloth; edges of more than two triangles are omitted
  VertexCurvature(int vertex_count, const std::vector<Triangle>& triangles);

  /// Returns the curvature.
  /// @param positions n×3 [m]
  /// @returns n; 0 at vertices without an area
  [[nodiscard]] Eigen::VectorXd operator()(const Vertices& positions) const;

 private:
  struct Hinge {
    Edge edge;
    std::array<int, 2> triangles;  // on both sides
    double turned;                 // -1 if they have opposite orientations, else 1
  };
  int vertex_count_;
  std::vector<Triangle> triangles_;
  std::vector<Hinge> hinges_;
};

}  // namespace drape
