#include "sim/collision/candidates.hpp"

#include <algorithm>

#include "sim/collision/impact.hpp"

namespace drape {
namespace {

Box around(const Box& a, const Box& b) { return {a.low.cwiseMin(b.low), a.high.cwiseMax(b.high)}; }

}  // namespace

bool may_come_near(Feature feature, const FourPoints& from, FourPoints to, double reach) {
  if (kept_apart(feature, from, to, reach)) return false;
  for (std::size_t i = 0; i < 4; ++i) to[i] -= from[i];
  const double near = reach + largest_change(feature, to);
  return nearest(feature, from).squared <= near * near;
}

CollisionCandidates::CollisionCandidates(const Cloth& cloth)
    : edges_(unique_edges(cloth.triangles)), pinned_(static_cast<std::size_t>(cloth.vertex_count()), false) {
  for (const Triangle& t : cloth.triangles) {
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) triangles_.push_back(t);
  }
  for (const Edge& edge : edges_) corners_.insert(corners_.end(), edge.begin(), edge.end());
  std::sort(corners_.begin(), corners_.end());
  corners_.erase(std::unique(corners_.begin(), corners_.end()), corners_.end());
  for (const int pin : cloth.pins) pinned_[static_cast<std::size_t>(pin)] = true;
}

void CollisionCandidates::find(const std::vector<Point>& from, const std::vector<Point>& to, double reach) {
  const Eigen::Vector3d margin = Eigen::Vector3d::Constant(reach / 2);
  vertex_boxes_.resize(from.size());
  for (std::size_t i = 0; i < from.size(); ++i) {
    vertex_boxes_[i] = {from[i].cwiseMin(to[i]) - margin, from[i].cwiseMax(to[i]) + margin};
  }
  const auto box = [&](int i) -> const Box& { return vertex_boxes_[static_cast<std::size_t>(i)]; };
  triangle_boxes_.resize(triangles_.size());
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    const auto& [a, b, c] = triangles_[t];
    triangle_boxes_[t] = around(around(box(a), box(b)), box(c));
  }
  edge_boxes_.resize(edges_.size());
  for (std::size_t e = 0; e < edges_.size(); ++e) edge_boxes_[e] = around(box(edges_[e][0]), box(edges_[e][1]));

  pairs_.clear();
  triangle_hash_.build(triangle_boxes_);
  for (const int i : corners_) {
    triangle_hash_.for_overlapping(box(i), [&](int k) {
      const auto& [a, b, c] = triangles_[static_cast<std::size_t>(k)];
      if (i != a && i != b && i != c) add({Feature::vertex_triangle, {i, a, b, c}}, from, to, reach);
    });
  }
  edge_hash_.build(edge_boxes_);
  edge_hash_.for_pairs([&](int k, int l) {
    const auto& [a, b] = edges_[static_cast<std::size_t>(k)];
    const auto& [c, d] = edges_[static_cast<std::size_t>(l)];
    if (a != c && a != d && b != c && b != d) add({Feature::edge_edge, {a, b, c, d}}, from, to, reach);
  });
  std::sort(pairs_.begin(), pairs_.end());
}

void CollisionCandidates::add(const FeaturePair& pair, const std::vector<Point>& from, const std::vector<Point>& to,
                              double reach) {
  const auto& v = pair.vertices;
  if (std::all_of(v.begin(), v.end(), [&](int i) { return pinned_[static_cast<std::size_t>(i)]; })) return;
  if (may_come_near(pair.feature, gather(from, v), gather(to, v), reach)) pairs_.push_back(pair);
}

}  // namespace drape
