#include "render/hem.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cstddef>
#include <map>

namespace drape {
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
