#include "scene/cloth_shape.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <vector>

namespace drape {
namespace {

constexpr double large = 100, small = 1e-3;  // warning limits [m]

/// Disjoint sets of vertices; the vertices of one piece have one root.
class Pieces {
 public:
  explicit Pieces(int count) : parents_(static_cast<std::size_t>(count)) {
    std::iota(parents_.begin(), parents_.end(), 0);
  }
  int root(int vertex) {
    while (parent(vertex) != vertex) {
      parent(vertex) = parent(parent(vertex));  // path compression
      vertex = parent(vertex);
    }
    return vertex;
  }
  /// Joins the sets of two vertices; returns true if they were separate.
  bool join(int a, int b) {
    const int from = root(a), to = root(b);
    parent(from) = to;
    return from != to;
  }

 private:
  int& parent(int vertex) { return parents_[static_cast<std::size_t>(vertex)]; }

  std::vector<int> parents_;
};

}  // namespace

ClothShape shape_of(const Cloth& cloth) {
  ClothShape shape;
  shape.extent = (cloth.positions.colwise().maxCoeff() - cloth.positions.colwise().minCoeff()).transpose();
  Pieces pieces(cloth.vertex_count());
  std::vector<bool> held(static_cast<std::size_t>(cloth.vertex_count()));
  for (const Spring& spring : cloth.springs) {
    for (const int end : {spring.i, spring.j}) {
      if (held[static_cast<std::size_t>(end)]) continue;
      held[static_cast<std::size_t>(end)] = true;
      ++shape.pieces;
    }
    if (pieces.join(spring.i, spring.j)) --shape.pieces;
    const double length = (cloth.positions.row(spring.i) - cloth.positions.row(spring.j)).norm();
    const bool first = &spring == &cloth.springs.front();
    shape.shortest_edge = first ? length : std::min(shape.shortest_edge, length);
    shape.longest_edge = std::max(shape.longest_edge, length);
  }
  return shape;
}

std::string ClothShape::text() const {
  constexpr double rounding = 1e-12;  // relative to the largest extent: thinner is flat
  const Eigen::Vector3d shown = (extent.array() > rounding * extent.maxCoeff()).select(extent, 0.0);
  return fmt::format("{} {} of {:.3g} × {:.3g} × {:.3g} m{}, edges of {:.3g} to {:.3g} m", pieces,
                     pieces == 1 ? "piece" : "pieces", shown.x(), shown.y(), shown.z(), pieces == 1 ? "" : " together",
                     shortest_edge, longest_edge);
}

std::optional<std::string> ClothShape::doubt() const {
  const double size = extent.maxCoeff();
  if (size <= large && size >= small) return std::nullopt;
  return fmt::format("the cloth is {:.3g} m {}: are its coordinates metres? [cloth.transform] scale changes them", size,
                     size > large ? "large" : "small");
}

bool seems_y_up(const Vertices& positions) {
  if (positions.rows() == 0) return false;
  const Eigen::RowVector3d low = positions.colwise().minCoeff(), high = positions.colwise().maxCoeff();
  const Eigen::RowVector3d extent = high - low, middle = (low + high) / 2;
  constexpr double thin = 0.3, centred = 0.25;
  const bool lies = extent.y() < thin * std::min(extent.x(), extent.z());
  const bool stands = low.y() > 0 && extent.y() > extent.z() && std::abs(middle.z()) < centred * extent.z();
  return lies || stands;
}

}  // namespace drape
