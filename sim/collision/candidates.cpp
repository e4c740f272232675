#include "sim/collision/candidates.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>

#include "sim/collision/impact.hpp"

namespace drape {
namespace {

using Index = std::size_t;

// Kept boxes cover between `least_ahead` and `most_ahead` further steps, limited to paths of `furthest` edge lengths.
// Longer paths would add more pairs than the list saves; below the least number no list is made.
constexpr double furthest = 0.5, most_ahead = 8, least_ahead = 2;
// Margin of kept boxes on all sides, in edge lengths, for changes of velocity.
constexpr double skin = 0.06;
// Initial capacity per vertex; cloth that is not crumpled has fewer pairs.
constexpr Eigen::Index usual_pairs = 16;
// Largest rounding error of shifted positions, as a fraction of the reach. With larger errors the kept boxes are
// ignored.
constexpr double lost = 1e-6;

Box around(const Box& a, const Box& b) { return {a.low.cwiseMin(b.low), a.high.cwiseMax(b.high)}; }

/// Returns the box around a box on its path, enlarged by a margin.
Box extended(const Box& box, const Point& way, double margin) {
  const Eigen::Vector3d all_around = Eigen::Vector3d::Constant(margin);
  return {box.low + way.cwiseMin(0.0) - all_around, box.high + way.cwiseMax(0.0) + all_around};
}

/// Returns the largest of all part(first, count), over index ranges that together cover `count`.
double largest_part(const Threads& threads, Eigen::Index count, const auto& part) {
  return reduce(threads, count, part, [](double a, double b) { return std::max(a, b); });
}

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
  for (const Edge& edge : edges_) {
    edge_length_ += (cloth.rest.row(edge[0]) - cloth.rest.row(edge[1])).norm() / static_cast<double>(edges_.size());
  }
  const Eigen::Index most = usual_pairs * std::ssize(corners_);
  kept_.reserve(static_cast<Index>(most));
  pairs_.reserve(static_cast<Index>(most));
  found_.reserve(most, usual_pairs * worth_dividing);
  for (const int pin : cloth.pins) pinned_[static_cast<std::size_t>(pin)] = 1;
}

void CollisionCandidates::surround(const std::vector<Point>& from, const std::vector<Point>& to, const Point& together,
                                   double margin) {
  const Eigen::Vector3d all_around = Eigen::Vector3d::Constant(margin);
  vertex_boxes_.resize(from.size());
  for_all(threads_, std::ssize(from), [&](Eigen::Index index) {
    const auto i = static_cast<Index>(index);
    const Point end = to[i] - together;
    vertex_boxes_[i] = {from[i].cwiseMin(end) - all_around, from[i].cwiseMax(end) + all_around};
  });
}

Box CollisionCandidates::box(const Edge& edge) const {
  return around(vertex_boxes_[static_cast<Index>(edge[0])], vertex_boxes_[static_cast<Index>(edge[1])]);
}

Box CollisionCandidates::box(const Triangle& t) const {
  return around(box(Edge{t[0], t[1]}), vertex_boxes_[static_cast<Index>(t[2])]);
}

bool CollisionCandidates::overlap(const FeaturePair& pair) const {
  const auto& [a, b, c, d] = pair.vertices;
  if (pair.feature == Feature::edge_edge) return box(Edge{a, b}).overlaps(box(Edge{c, d}));
  return vertex_boxes_[static_cast<Index>(a)].overlaps(box(Triangle{b, c, d}));
}

template <class Accept>
void CollisionCandidates::search(Accept&& accept, std::vector<FeaturePair>& pairs) {
  triangle_boxes_.resize(triangles_.size());
  for_all(threads_, std::ssize(triangles_),
          [&](Eigen::Index t) { triangle_boxes_[static_cast<Index>(t)] = box(triangles_[static_cast<Index>(t)]); });
  edge_boxes_.resize(edges_.size());
  for_all(threads_, std::ssize(edges_),
          [&](Eigen::Index e) { edge_boxes_[static_cast<Index>(e)] = box(edges_[static_cast<Index>(e)]); });
  threads_.for_each(2, [&](int part) {
    if (part == 0) {
      edge_hash_.build(edge_boxes_);
    } else {
      triangle_hash_.build(triangle_boxes_);
    }
  });
  const auto add = [&](const FeaturePair& pair, std::vector<FeaturePair>& found) {
    const auto& v = pair.vertices;
    if (std::all_of(v.begin(), v.end(), [&](int i) { return pinned_[static_cast<Index>(i)] != 0; })) return;
    if (accept(pair)) found.push_back(pair);
  };
  // Features are visited in order, so only the pairs of each need sorting.
  const auto find_all = [&](Index count, auto&& find_of) {
    found_.fill(threads_, static_cast<Eigen::Index>(count), [&](Eigen::Index k, std::vector<FeaturePair>& found) {
      const auto before = static_cast<std::ptrdiff_t>(found.size());
      find_of(static_cast<Index>(k), found);
      std::sort(found.begin() + before, found.end());
    });
    found_.append_to(pairs);
  };
  pairs.clear();
  find_all(corners_.size(), [&](Index k, std::vector<FeaturePair>& found) {
    const int i = corners_[k];
    triangle_hash_.for_overlapping(vertex_boxes_[static_cast<Index>(i)], [&](int t) {
      const auto& [a, b, c] = triangles_[static_cast<Index>(t)];
      if (i != a && i != b && i != c) add({Feature::vertex_triangle, {i, a, b, c}}, found);
    });
  });
  find_all(edges_.size(), [&](Index k, std::vector<FeaturePair>& found) {
    const Edge& edge = edges_[k];
    edge_hash_.for_later(static_cast<int>(k), [&](int l) {
      const auto& [a, b] = edge;
      const auto& [c, d] = edges_[static_cast<Index>(l)];
      if (a != c && a != d && b != c && b != d) add({Feature::edge_edge, {a, b, c, d}}, found);
    });
  });
}

void CollisionCandidates::find(const std::vector<Point>& from, const std::vector<Point>& to, double reach) {
  const auto comes_near = [&](const FeaturePair& pair) {
    return may_come_near(pair.feature, gather(from, pair.vertices), gather(to, pair.vertices), reach);
  };
  const Point middle = mean(from), together = mean(to) - middle;
  surround(from, to, together, (0.5 + lost) * reach);
  if (!kept_cover(middle - kept_middle_, lost * reach)) {
    const double ahead = steps_ahead(from, to, together);
    if (ahead < least_ahead) {
      kept_boxes_.clear();
      search(comes_near, pairs_);
      return;
    }
    kept_boxes_.swap(vertex_boxes_);
    vertex_boxes_.resize(from.size());
    for_all(threads_, std::ssize(from), [&](Eigen::Index index) {
      const auto i = static_cast<Index>(index);
      vertex_boxes_[i] = extended(kept_boxes_[i], ahead * (to[i] - from[i] - together), skin * edge_length_);
    });
    search([](const FeaturePair&) { return true; }, kept_);
    kept_boxes_.swap(vertex_boxes_);
    kept_middle_ = middle;
  }
  found_.fill(threads_, std::ssize(kept_), [&](Eigen::Index k, std::vector<FeaturePair>& found) {
    const FeaturePair& pair = kept_[static_cast<Index>(k)];
    if (overlap(pair) && comes_near(pair)) found.push_back(pair);
  });
  pairs_.clear();
  found_.append_to(pairs_);
}

Point CollisionCandidates::mean(const std::vector<Point>& points) const {
  const auto part = [&](Eigen::Index first, Eigen::Index count) {
    const auto begin = points.begin() + first;
    return std::accumulate(begin, begin + count, Point(0, 0, 0));
  };
  return sum_of(threads_, std::ssize(points), part) / static_cast<double>(points.size());
}

bool CollisionCandidates::kept_cover(const Point& shift, double rounding) const {
  if (kept_boxes_.size() != vertex_boxes_.size()) return false;
  const Eigen::Vector3d margin = Eigen::Vector3d::Constant(rounding);
  const auto largest_of = [&](Eigen::Index first, Eigen::Index count) {
    double largest = 0;
    for (auto i = static_cast<Index>(first); i < static_cast<Index>(first + count); ++i) {
      const Box &box = vertex_boxes_[i], &kept = kept_boxes_[i];
      if (!((box.low - shift - margin).array() >= kept.low.array()).all() ||
          !((box.high - shift + margin).array() <= kept.high.array()).all()) {
        return std::numeric_limits<double>::infinity();
      }
      largest = std::max({largest, box.low.cwiseAbs().maxCoeff(), box.high.cwiseAbs().maxCoeff(),
                          kept.low.cwiseAbs().maxCoeff(), kept.high.cwiseAbs().maxCoeff()});
    }
    return largest;
  };
  return 8 * std::numeric_limits<double>::epsilon() * largest_part(threads_, std::ssize(kept_boxes_), largest_of) <
         rounding;
}

double CollisionCandidates::steps_ahead(const std::vector<Point>& from, const std::vector<Point>& to,
                                        const Point& together) const {
  const auto longest_of = [&](Eigen::Index first, Eigen::Index count) {
    double longest = lost * edge_length_;
    for (auto i = static_cast<Index>(first); i < static_cast<Index>(first + count); ++i) {
      longest = std::max(longest, (to[i] - from[i] - together).cwiseAbs().maxCoeff());
    }
    return longest;
  };
  return std::min(most_ahead, furthest * edge_length_ / largest_part(threads_, std::ssize(from), longest_of));
}

}  // namespace drape
