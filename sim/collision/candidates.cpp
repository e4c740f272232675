#include "sim/collision/candidates.hpp"

#include <algorithm>
#include <iterator>

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

CollisionCandidates::CollisionCandidates(const Cloth& cloth, const Threads& threads)
    : threads_(for_so_many(threads, cloth.vertex_count())),
      edges_(unique_edges(cloth.triangles)),
      pinned_(static_cast<std::size_t>(cloth.vertex_count()), 0) {
  for (const Triangle& t : cloth.triangles) {
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) triangles_.push_back(t);
  }
  for (const Edge& edge : edges_) corners_.insert(corners_.end(), edge.begin(), edge.end());
  std::sort(corners_.begin(), corners_.end());
  corners_.erase(std::unique(corners_.begin(), corners_.end()), corners_.end());
  for (const int pin : cloth.pins) pinned_[static_cast<std::size_t>(pin)] = 1;
}

void CollisionCandidates::surround(const std::vector<Point>& from, const std::vector<Point>& to, double margin) {
  const auto box = [&](int i) -> const Box& { return vertex_boxes_[static_cast<std::size_t>(i)]; };
  const Eigen::Vector3d all_around = Eigen::Vector3d::Constant(margin);
  vertex_boxes_.resize(from.size());
  for_all(threads_, std::ssize(from), [&](Eigen::Index index) {
    const auto i = static_cast<std::size_t>(index);
    vertex_boxes_[i] = {from[i].cwiseMin(to[i]) - all_around, from[i].cwiseMax(to[i]) + all_around};
  });
  triangle_boxes_.resize(triangles_.size());
  for_all(threads_, std::ssize(triangles_), [&](Eigen::Index t) {
    const auto& [a, b, c] = triangles_[static_cast<std::size_t>(t)];
    triangle_boxes_[static_cast<std::size_t>(t)] = around(around(box(a), box(b)), box(c));
  });
  edge_boxes_.resize(edges_.size());
  for_all(threads_, std::ssize(edges_), [&](Eigen::Index e) {
    const auto& [a, b] = edges_[static_cast<std::size_t>(e)];
    edge_boxes_[static_cast<std::size_t>(e)] = around(box(a), box(b));
  });
}

void CollisionCandidates::find(const std::vector<Point>& from, const std::vector<Point>& to, double reach) {
  surround(from, to, reach / 2);
  threads_.for_each(2, [&](int part) {
    if (part == 0) {
      edge_hash_.build(edge_boxes_);
    } else {
      triangle_hash_.build(triangle_boxes_);
    }
  });
  const auto add = [&](const FeaturePair& pair, std::vector<FeaturePair>& found) {
    const auto& v = pair.vertices;
    if (std::all_of(v.begin(), v.end(), [&](int i) { return pinned_[static_cast<std::size_t>(i)] != 0; })) return;
    if (may_come_near(pair.feature, gather(from, v), gather(to, v), reach)) found.push_back(pair);
  };
  // Features are gone through in their order, so only the pairs of each have to be sorted.
  const auto find_all = [&](std::size_t count, auto&& find_of) {
    found_.fill(threads_, static_cast<Eigen::Index>(count), [&](Eigen::Index k, std::vector<FeaturePair>& found) {
      const auto before = static_cast<std::ptrdiff_t>(found.size());
      find_of(static_cast<std::size_t>(k), found);
      std::sort(found.begin() + before, found.end());
    });
    found_.append_to(pairs_);
  };
  pairs_.clear();
  find_all(corners_.size(), [&](std::size_t k, std::vector<FeaturePair>& found) {
    const int i = corners_[k];
    triangle_hash_.for_overlapping(vertex_boxes_[static_cast<std::size_t>(i)], [&](int t) {
      const auto& [a, b, c] = triangles_[static_cast<std::size_t>(t)];
      if (i != a && i != b && i != c) add({Feature::vertex_triangle, {i, a, b, c}}, found);
    });
  });
  find_all(edges_.size(), [&](std::size_t k, std::vector<FeaturePair>& found) {
    const Edge& edge = edges_[k];
    edge_hash_.for_later(static_cast<int>(k), [&](int l) {
      const auto& [a, b] = edge;
      const auto& [c, d] = edges_[static_cast<std::size_t>(l)];
      if (a != c && a != d && b != c && b != d) add({Feature::edge_edge, {a, b, c, d}}, found);
    });
  });
}

}  // namespace drape
