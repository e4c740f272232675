#include "render/smooth_surface.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <set>

namespace drape {
namespace {

/// Pixels per piece if the cloth fills a third of the picture.
constexpr double piece_pixels = 16, filled_part = 0.33;
constexpr int most_levels = 3;
constexpr std::size_t most_pieces = 60000;

/// Fraction of a vertex's displacement to the limit surface by which its control point moves the opposite way. With 1
/// the surface lies so near the vertices that a body's corner stays below it.
constexpr double sharpness = 1;

/// Most triangles of a crease vertex that counts as a corner.
constexpr int corner_triangles = 2;

struct EdgeUse {
  int number = 0;  // of the edge
  int uses = 0;
  std::array<int, 2> opposite{};  // opposite vertices in the first two triangles
};

/// The neighbourhoods of a mesh's vertices.
struct Neighbourhood {
  std::map<Edge, EdgeUse> edges;
  std::vector<std::vector<int>> neighbors, crease_neighbors;
  std::vector<int> triangle_counts;

  Neighbourhood(const std::vector<Triangle>& triangles, int vertex_count)
      : neighbors(static_cast<std::size_t>(vertex_count)),
        crease_neighbors(neighbors),
        triangle_counts(neighbors.size(), 0) {
    for (const Triangle& t : triangles) {
      for (std::size_t c = 0; c < 3; ++c) {
        ++triangle_counts[static_cast<std::size_t>(t[c])];
        EdgeUse& use = edges[undirected(t[(c + 1) % 3], t[(c + 2) % 3])];
        if (use.uses < 2) use.opposite[static_cast<std::size_t>(use.uses)] = t[c];
        ++use.uses;
      }
    }
    int number = vertex_count;
    for (auto& [edge, use] : edges) {
      use.number = number++;
      for (const auto& [from, to] : {std::pair(edge[0], edge[1]), std::pair(edge[1], edge[0])}) {
        neighbors[static_cast<std::size_t>(from)].push_back(to);
        if (use.uses != 2) crease_neighbors[static_cast<std::size_t>(from)].push_back(to);
      }
    }
  }
};

using Weights = Eigen::SparseMatrix<double, Eigen::RowMajor>;
using Entries = std::vector<Eigen::Triplet<double>>;

/// Adds the weights of a vertex: a mean of itself and its neighbours, or its neighbours along a crease.
/// @param limit true: its position on the limit surface; false: its position on the next level
void add_vertex(Entries& entries, const Neighbourhood& mesh, int vertex, bool limit) {
  const auto i = static_cast<std::size_t>(vertex);
  const std::vector<int>& creases = mesh.crease_neighbors[i];
  const std::vector<int>* around = nullptr;
  double each = 0;
  if (creases.size() == 2 && mesh.triangle_counts[i] > corner_triangles) {
    around = &creases;
    each = limit ? 1.0 / 6 : 1.0 / 8;
  } else if (creases.empty() && mesh.neighbors[i].size() >= 3) {
    around = &mesh.neighbors[i];
    const auto n = static_cast<double>(around->size());
    const double beta = n == 3 ? 3.0 / 16 : 3 / (8 * n);
    each = limit ? 1 / (n + 3 / (8 * beta)) : beta;
  }
  double own = 1;
  if (around != nullptr) {
    own -= each * static_cast<double>(around->size());
    for (const int other : *around) entries.emplace_back(vertex, other, each);
  }
  entries.emplace_back(vertex, vertex, own);
}

Weights matrix(int rows, int columns, const Entries& entries) {
  Weights weights(rows, columns);
  weights.setFromTriplets(entries.begin(), entries.end());
  return weights;
}

}  // namespace

int SmoothSurface::levels_for(std::size_t triangle_count, double pixels) {
  if (triangle_count == 0) return 0;
  const double ratio = filled_part * pixels / piece_pixels / static_cast<double>(triangle_count);
  int levels = std::clamp(static_cast<int>(std::lround(std::log2(std::max(ratio, 1e-6)) / 2)), 0, most_levels);
  while (levels > 0 && (triangle_count << (2 * levels)) > most_pieces) --levels;
  return levels;
}

SmoothSurface::SmoothSurface(const std::vector<Triangle>& triangles, int levels) {
  bool degenerate = false;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const Triangle& corners = triangles[t];
    degenerate = degenerate || corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0];
    pieces_.push_back({corners, static_cast<int>(t), {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}});
    vertex_count_ = std::max(vertex_count_, 1 + std::max({corners[0], corners[1], corners[2]}));
  }
  if (!degenerate) {
    for (int k = 0; k < levels; ++k) divide();
  }
  triangles_.clear();
  for (const Piece& piece : pieces_) triangles_.push_back(piece.corners);
  if (divided_) project_to_limit();
}

void SmoothSurface::divide() {
  triangles_.clear();
  for (const Piece& piece : pieces_) triangles_.push_back(piece.corners);
  const Neighbourhood mesh(triangles_, vertex_count_);
  Entries entries;
  for (int i = 0; i < vertex_count_; ++i) add_vertex(entries, mesh, i, false);
  for (const auto& [edge, use] : mesh.edges) {
    const double own = use.uses == 2 ? 3.0 / 8 : 1.0 / 2;
    for (const int end : edge) entries.emplace_back(use.number, end, own);
    if (use.uses != 2) continue;
    for (const int opposite : use.opposite) entries.emplace_back(use.number, opposite, 1.0 / 8);
  }
  const int count = vertex_count_ + static_cast<int>(mesh.edges.size());
  const Weights step = matrix(count, vertex_count_, entries);
  weights_ = divided_ ? Weights(step * weights_) : step;
  divided_ = true;
  vertex_count_ = count;

  std::vector<Piece> finer;
  finer.reserve(4 * pieces_.size());
  for (const Piece& piece : pieces_) {
    std::array<int, 3> middles{};
    std::array<std::array<float, 3>, 3> weights{};
    for (std::size_t c = 0; c < 3; ++c) {  // edge opposite corner c
      const std::size_t p = (c + 1) % 3, q = (c + 2) % 3;
      middles[c] = mesh.edges.at(undirected(piece.corners[p], piece.corners[q])).number;
      for (std::size_t k = 0; k < 3; ++k) weights[c][k] = (piece.weights[p][k] + piece.weights[q][k]) / 2;
    }
    for (std::size_t c = 0; c < 3; ++c) {
      const std::size_t p = (c + 1) % 3, q = (c + 2) % 3;
      finer.push_back(
          {{piece.corners[c], middles[q], middles[p]}, piece.parent, {piece.weights[c], weights[q], weights[p]}});
    }
    finer.push_back({middles, piece.parent, weights});
  }
  pieces_ = std::move(finer);
}

void SmoothSurface::project_to_limit() {
  const Neighbourhood mesh(triangles_, vertex_count_);
  Entries entries;
  for (int i = 0; i < vertex_count_; ++i) add_vertex(entries, mesh, i, true);
  weights_ = Weights(matrix(vertex_count_, vertex_count_, entries) * weights_);
  limits_ = weights_.topRows(weights_.cols());
}

Vertices SmoothSurface::positions(const Vertices& vertices) const {
  if (!divided_) return vertices.topRows(vertex_count_);
  const auto given = vertices.topRows(weights_.cols());
  Vertices controls = given;
  controls += sharpness * (given - limits_ * given);
  return weights_ * controls;
}

Vertices vertex_normals(const Vertices& positions, const std::vector<Triangle>& triangles) {
  Vertices normals = Vertices::Zero(positions.rows(), 3);
  for (const Triangle& t : triangles) {
    const Eigen::RowVector3d a = positions.row(t[0]);
    const Eigen::RowVector3d twice_area = (positions.row(t[1]) - a).cross(positions.row(t[2]) - a);
    for (const int vertex : t) normals.row(vertex) += twice_area;
  }
  for (Eigen::Index i = 0; i < normals.rows(); ++i) {
    const double length = normals.row(i).norm();
    if (length > 0) {
      normals.row(i) /= length;
    } else {
      normals.row(i) = Eigen::RowVector3d::UnitZ();
    }
  }
  return normals;
}

namespace {

/// Largest radius of the tube as a fraction of an edge's length, for a small or finely divided cloth.
constexpr double largest_radius = 0.25;

struct BorderEdge {
  int from, to, piece;
  std::size_t corner;  // corner of `from`
};

/// Returns the edges with one triangle, in the order of the pieces.
std::vector<BorderEdge> border_edges(const std::vector<SmoothSurface::Piece>& pieces) {
  std::map<Edge, int> uses;
  for (const auto& piece : pieces) {
    for (std::size_t c = 0; c < 3; ++c) ++uses[undirected(piece.corners[c], piece.corners[(c + 1) % 3])];
  }
  std::vector<BorderEdge> edges;
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    for (std::size_t c = 0; c < 3; ++c) {
      const int from = pieces[k].corners[c], to = pieces[k].corners[(c + 1) % 3];
      if (from != to && uses[undirected(from, to)] == 1) edges.push_back({from, to, static_cast<int>(k), c});
    }
  }
  return edges;
}

}  // namespace

Hem::Hem(const SmoothSurface& surface, double thickness) : thickness_(thickness) {
  if (!(thickness > 0)) return;
  const std::vector<BorderEdge> edges = border_edges(surface.pieces());
  std::map<int, int> numbers;  // numbers of the border's vertices
  const auto number_of = [&](int vertex, const Corner& corner) {
    const auto [known, is_new] = numbers.try_emplace(vertex, static_cast<int>(border_.size()));
    if (is_new) {
      border_.push_back({vertex, vertex, vertex});
      corners_.insert(corners_.end(), ring, corner);
    }
    return known->second;
  };
  const int first = surface.vertex_count();
  for (const BorderEdge& edge : edges) {
    const int p = number_of(edge.from, {edge.piece, edge.corner}),
              q = number_of(edge.to, {edge.piece, (edge.corner + 1) % 3});
    border_[static_cast<std::size_t>(p)].after = edge.to;
    border_[static_cast<std::size_t>(q)].before = edge.from;
    for (int k = 0; k + 1 < ring; ++k) {  // from the front to the back
      const int a = first + ring * p + k, b = first + ring * q + k;
      triangles_.push_back({a, a + 1, b});
      triangles_.push_back({b, a + 1, b + 1});
      pieces_.insert(pieces_.end(), 2, edge.piece);
    }
    const int inside = surface.pieces()[static_cast<std::size_t>(edge.piece)].corners[(edge.corner + 2) % 3];
    for (const int k : {0, ring - 1}) joints_.push_back({first + ring * p + k, first + ring * q + k, inside});
  }
}

void Hem::append(Vertices& positions, Vertices& normals) const {
  if (border_.empty()) return;
  const Eigen::Index first = positions.rows();
  double length = 0;
  for (const BorderVertex& v : border_) length += (positions.row(v.after) - positions.row(v.vertex)).norm();
  const double radius = std::min(thickness_ / 2, largest_radius * length / static_cast<double>(border_.size()));
  positions.conservativeResize(first + static_cast<Eigen::Index>(corners_.size()), 3);
  normals.conservativeResize(positions.rows(), 3);
  for (std::size_t i = 0; i < border_.size(); ++i) {
    const BorderVertex& v = border_[i];
    const Eigen::Vector3d middle = positions.row(v.vertex), front = normals.row(v.vertex);
    const Eigen::Vector3d along = (positions.row(v.after) - positions.row(v.before)).transpose();
    const Eigen::Vector3d outwards = along.cross(front).stableNormalized();
    const std::array<Eigen::Vector3d, ring> around{front, outwards, -front};
    for (std::size_t k = 0; k < around.size(); ++k) {
      const Eigen::Index vertex = first + static_cast<Eigen::Index>(ring * i + k);
      positions.row(vertex) = (middle + radius * around[k]).transpose();
      normals.row(vertex) = around[k].transpose();
    }
  }
}

}  // namespace drape
