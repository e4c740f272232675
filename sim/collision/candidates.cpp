#include "sim/collision/candidates.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>

#include "sim/kernels/kernels.hpp"

namespace drape {
namespace {

using Index = std::size_t;

// Initial capacity per vertex; cloth that is not crumpled has fewer pairs.
constexpr Eigen::Index usual_pairs = 16;
// Part of the reach that rounding errors of the boxes stay below.
constexpr double box_rounding = 1e-6;
// Features whose pairs are filtered together: enough to fill the lanes, few enough for the cache.
constexpr std::size_t features_per_block = 16;

// Margins of PairFilter:
constexpr double slab_rounding = 64 * 0x1p-24;  // of a slab's width, in sizes
constexpr double square_rounding = 0x1p-20;     // of squares, relative
constexpr double least_reach = 1e-15;           // its square is a normal number in single precision [m]

}  // namespace

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
  const Eigen::Index most = usual_pairs * std::ssize(corners_);
  pairs_.reserve(static_cast<Index>(most));
  found_.reserve(most, usual_pairs * worth_dividing);
  for (const int pin : cloth.pins) pinned_[static_cast<std::size_t>(pin)] = 1;
}

void CollisionCandidates::surround(const std::vector<Point>& from, const std::vector<Point>& to, const Point& together,
                                   double margin) {
  vertex_boxes_.resize(from.size());
  for_all(threads_, std::ssize(from), [&](Eigen::Index index) {
    const auto i = static_cast<Index>(index);
    const Point end = to[i] - together;
    vertex_boxes_[i] = larger(Box(from[i]).extend(end), margin);
  });
}

Box CollisionCandidates::box(const Edge& edge) const {
  return vertex_boxes_[static_cast<Index>(edge[0])].merged(vertex_boxes_[static_cast<Index>(edge[1])]);
}

Box CollisionCandidates::box(const Triangle& t) const {
  return box(Edge{t[0], t[1]}).merged(vertex_boxes_[static_cast<Index>(t[2])]);
}

void CollisionCandidates::find(const std::vector<Point>& from, const std::vector<Point>& to, double reach) {
  surround(from, to, mean(to) - mean(from), (0.5 + box_rounding) * reach);
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
  filter_.set(from, to);
  pairs_.clear();
  find_pairs(Feature::vertex_triangle, corners_.size(), reach, [&](Index k, auto&& add) {
    const int i = corners_[k];
    triangle_hash_.for_overlapping(vertex_boxes_[static_cast<Index>(i)], [&](int t) {
      const auto& [a, b, c] = triangles_[static_cast<Index>(t)];
      if (i != a && i != b && i != c) add({i, a, b, c});
    });
  });
  vertex_pairs_ = pairs_.size();
  find_pairs(Feature::edge_edge, edges_.size(), reach, [&](Index k, auto&& add) {
    const Edge& edge = edges_[k];
    edge_hash_.for_later(static_cast<int>(k), [&](int l) {
      const auto& [a, b] = edge;
      const auto& [c, d] = edges_[static_cast<Index>(l)];
      if (a != c && a != d && b != c && b != d) add({a, b, c, d});
    });
  });
}

template <class Find>
void CollisionCandidates::find_pairs(Feature feature, Index count, double reach, Find&& find) {
  const auto pinned = [&](int i) { return pinned_[static_cast<Index>(i)] != 0; };
  const Index blocks = (count + features_per_block - 1) / features_per_block;
  const auto find_block = [&](Eigen::Index block, std::vector<FeaturePair>& found) {
    const Index first = static_cast<Index>(block) * features_per_block, before = found.size();
    for (Index k = first; k < std::min(first + features_per_block, count); ++k) {
      find(k, [&](const std::array<int, 4>& vertices) {
        if (!std::ranges::all_of(vertices, pinned)) found.push_back({feature, vertices});
      });
    }
    Index near = before;
    filter_.for_near(feature, std::span(found).subspan(before), reach,
                     [&](const FeaturePair& pair) { found[near++] = pair; });
    found.resize(near);
    std::ranges::sort(found.begin() + static_cast<std::ptrdiff_t>(before), found.end());
  };
  found_.fill(threads_, static_cast<Eigen::Index>(blocks), find_block, worth_dividing / features_per_block);
  found_.append_to(pairs_);
}

Point CollisionCandidates::mean(const std::vector<Point>& points) const {
  const auto part = [&](Eigen::Index first, Eigen::Index count) {
    const auto begin = points.begin() + first;
    return std::accumulate(begin, begin + count, Point(0, 0, 0));
  };
  return sum_of(threads_, std::ssize(points), part) / static_cast<double>(points.size());
}

namespace {

using Index = std::size_t;

constexpr int group_size = 12;          // maximum number of triangles
constexpr std::size_t usual_near = 32;  // body triangles near a group; its memory grows if there are more

/// Returns an upper bound on the displacement of the body's points in the step, relative to an earlier travel [m].
double travel_since(double travel, const BodyStep& step) {
  return std::max(std::abs(step.start.travel() - travel), std::abs(step.end.travel() - travel));
}

/// Returns true if a slab along a body triangle, wider than `reach` [m], separates it from a cloth triangle throughout
/// the step.
bool parted(const Triangle& a, const Triangle& b, const Point& axis, const BodyStep& step, double reach) {
  double above = std::numeric_limits<double>::infinity(), below = above;
  for (const std::vector<Point>* at : {&step.from, &step.to}) {
    const auto height = [&](int i) { return axis.dot((*at)[Index(i)]); };
    const double a0 = height(a[0]), a1 = height(a[1]), a2 = height(a[2]);
    const double b0 = height(b[0]), b1 = height(b[1]), b2 = height(b[2]);
    above = std::min(above, std::min({a0, a1, a2}) - std::max({b0, b1, b2}));
    below = std::min(below, std::min({b0, b1, b2}) - std::max({a0, a1, a2}));
  }
  return std::max(above, below) > reach;
}

}  // namespace

BodyCandidates::BodyCandidates(const MeshTopology& body, int body_vertices, const Cloth& cloth, double margin,
                               const Threads& threads)
    : threads_(for_so_many(threads, cloth.vertex_count())),
      cloth_count_(cloth.vertex_count()),
      margin_(margin),
      pinned_(Index(cloth_count_), 0),
      body_patches_(make_patches(body.triangles, cloth_count_, body_vertices)) {
  for (const int pin : cloth.pins) pinned_[Index(pin)] = 1;
  const std::vector<Patch> patches = make_patches(cloth.triangles, 0, cloth_count_);
  std::vector<Box> boxes;
  for (const Patch& patch : patches) {
    const auto corner = [&](int i) -> Point { return cloth.rest.row(i).transpose(); };
    const Point a = corner(patch.corners[0]), b = corner(patch.corners[1]), c = corner(patch.corners[2]);
    boxes.push_back(Box(a).extend(b).extend(c));
  }
  TriangleTree tree;
  tree.build(boxes, group_size);
  std::vector<std::pair<Index, Index>> ends;  // ends of the groups' triangles and vertices
  tree.for_leaves([&](std::span<const int> leaf) {
    const auto first = static_cast<std::ptrdiff_t>(vertices_.size());
    for (const int t : leaf) {
      cloth_patches_.push_back(patches[Index(t)]);
      const Triangle& corners = patches[Index(t)].corners;
      vertices_.insert(vertices_.end(), corners.begin(), corners.end());
    }
    std::sort(vertices_.begin() + first, vertices_.end());
    vertices_.erase(std::unique(vertices_.begin() + first, vertices_.end()), vertices_.end());
    ends.emplace_back(cloth_patches_.size(), vertices_.size());
  });
  findings_.resize(threads_.count() == 1 ? 1 : most_parts);
  Index patch = 0, vertex = 0;
  for (const auto& [patch_end, vertex_end] : ends) {
    groups_.push_back({std::span<const Patch>(cloth_patches_).subspan(patch, patch_end - patch),
                       std::span<const int>(vertices_).subspan(vertex, vertex_end - vertex)});
    groups_.back().near.reserve(usual_near);
    patch = patch_end;
    vertex = vertex_end;
  }
}

void BodyCandidates::find(const BodyStep& step, double reach) {
  const int parts = static_cast<int>(findings_.size());
  const auto count = static_cast<Eigen::Index>(groups_.size());
  threads_.for_each(parts, [&](int part) {
    SearchResults& findings = findings_[Index(part)];
    findings.pairs.clear();
    for (auto g = begin_of_part(count, part, parts); g < begin_of_part(count, part + 1, parts); ++g) {
      find_of(groups_[Index(g)], step, reach, findings);
    }
  });
  pairs_.clear();
  for (const SearchResults& findings : findings_) {
    pairs_.insert(pairs_.end(), findings.pairs.begin(), findings.pairs.end());
  }
}

void BodyCandidates::find_of(Group& group, const BodyStep& step, double reach, SearchResults& findings) const {
  const Box box = box_of_paths(group.vertices, step.from, step.to);
  if (!group.region.contains(larger(box, reach + travel_since(group.travel, step)))) {
    look_around(group, box, step, reach);
  }
  if (group.near.empty() || apart(group, step, reach)) return;
  place_plane(group, step);
  if (!apart(group, step, reach)) add_group(group, step, reach, findings);
}

void BodyCandidates::look_around(Group& group, const Box& box, const BodyStep& step, double reach) const {
  const TriangleTree& tree = step.end.tree();
  const double in_step = std::abs(step.end.travel() - step.start.travel());
  const double margin = std::max(margin_, box.exteriorDistance(tree.bounds()) / 2);
  group.region = larger(box, reach + in_step + margin);
  group.travel = step.end.travel();
  group.near.clear();
  tree.for_overlapping(group.region, [&](int t) {
    if (group.region.intersects(step.end.boxes()[Index(t)])) group.near.push_back(t);
  });
  std::ranges::sort(group.near);
  group.level = std::numeric_limits<double>::infinity();  // no plane yet
}

void BodyCandidates::place_plane(Group& group, const BodyStep& step) {
  const PlacedMesh& mesh = step.end;
  Point middle = Point::Zero(), sum = Point::Zero();
  for (const int i : group.vertices) middle += step.to[Index(i)];
  middle /= static_cast<double>(group.vertices.size());
  for (const int t : group.near) {
    const Point& normal = mesh.face_normal(t);
    const double side = normal.dot(middle - mesh.points()[Index(mesh.topology().triangles[Index(t)][0])]);
    sum += side < 0 ? Point(-normal) : normal;
  }
  group.of_travel = mesh.travel();
  group.axis = sum.stableNormalized();
  group.level = -std::numeric_limits<double>::infinity();
  for (const int t : group.near) {
    for (const int i : mesh.topology().triangles[Index(t)]) {
      group.level = std::max(group.level, group.axis.dot(mesh.points()[Index(i)]));
    }
  }
}

bool BodyCandidates::apart(const Group& group, const BodyStep& step, double reach) {
  double lowest = std::numeric_limits<double>::infinity();
  for (const int i : group.vertices) {
    lowest = std::min({lowest, group.axis.dot(step.from[Index(i)]), group.axis.dot(step.to[Index(i)])});
  }
  return lowest - group.level > reach + travel_since(group.of_travel, step);
}

void BodyCandidates::add_group(const Group& group, const BodyStep& step, double reach, SearchResults& findings) const {
  const Box around = larger(box_of_paths(group.vertices, step.from, step.to), reach);
  auto& [pairs, near, near_boxes] = findings;
  near.clear();
  near_boxes.clear();
  for (const int t : group.near) {
    const Box& box = step.start.boxes()[Index(t)];
    const Box on_its_way = &step.start == &step.end ? box : box.merged(step.end.boxes()[Index(t)]);
    if (!around.intersects(on_its_way)) continue;
    near.push_back(t);
    near_boxes.push_back(on_its_way);
  }
  for (const Patch& patch : group.patches) {
    const Box box = larger(box_of_paths(patch.corners, step.from, step.to), reach);
    for (Index k = 0; k < near.size(); ++k) {
      if (!box.intersects(near_boxes[k])) continue;
      const int t = near[k];
      if (parted(patch.corners, body_patches_[Index(t)].corners, step.start.face_normal(t), step, reach)) continue;
      add_pairs(patch, t, step, reach, pairs);
    }
  }
}

void BodyCandidates::add_pairs(const Patch& patch, int triangle, const BodyStep& step, double reach,
                               std::vector<BodyPair>& pairs) const {
  const Patch& body = body_patches_[Index(triangle)];
  const auto &a = patch.corners, &b = body.corners;
  for (Index c = 0; c < 3; ++c) {
    if (patch.own_vertex[c]) add({Feature::vertex_triangle, {a[c], b[0], b[1], b[2]}}, step, reach, pairs);
    if (body.own_vertex[c]) add({Feature::vertex_triangle, {b[c], a[0], a[1], a[2]}}, step, reach, pairs);
    if (!patch.own_edge[c]) continue;
    for (Index d = 0; d < 3; ++d) {
      if (!body.own_edge[d]) continue;
      add({Feature::edge_edge, {a[c], a[(c + 1) % 3], b[d], b[(d + 1) % 3]}}, step, reach, pairs);
    }
  }
}

void BodyCandidates::add(const FeaturePair& pair, const BodyStep& step, double reach,
                         std::vector<BodyPair>& pairs) const {
  const auto& v = pair.vertices;
  if (std::ranges::all_of(v, [&](int i) { return i >= cloth_count_ || pinned_[Index(i)] != 0; })) return;
  const FourPoints from = gather(step.from, v), to = gather(step.to, v);
  if (kept_apart(pair.feature, from, to, reach)) return;
  const Nearest before = nearest(pair.feature, from);
  // Near the start of the step, the line between the closest points is the best separating axis.
  if (kept_apart(pair.feature, before.difference(from), from, to, reach)) return;
  pairs.push_back({pair, std::sqrt(before.squared)});
}

void PairFilter::set(const std::vector<Point>& from, const std::vector<Point>& to) {
  rows_.resize(from.size());
  size_ = 0;
  if (from.empty()) return;
  std::size_t first = 0;
  for (const std::vector<Point>* points : {&from, &to}) {
    Point low = points->front(), high = low, sum = Point::Zero();
    for (const Point& p : *points) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
      sum += p;
    }
    const Point middle = (low + high) / 2;
    // Nothing is rejected if a number is not finite.
    size_ = sum.allFinite() ? std::max(size_, (high - low).maxCoeff() / 2) : std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < points->size(); ++i) {
      const Eigen::Vector3f p = ((*points)[i] - middle).cast<float>();
      rows_[i][first] = p.x();
      rows_[i][first + 1] = p.y();
      rows_[i][first + 2] = p.z();
      rows_[i][first + 3] = 0;
    }
    first += 4;
  }
}

int PairFilter::find(Feature feature, std::span<const FeaturePair> pairs, double reach,
                     std::array<int, at_once>& near) const {
  static_assert(sizeof(FeaturePair) % sizeof(int) == 0);
  const double enlarged = std::max((reach + slab_rounding * size_) * (1 + square_rounding), least_reach);
  const PairPaths paths{.rows = rows_.front().data(),
                        .vertices = pairs.front().vertices.data(),
                        .stride = sizeof(FeaturePair) / sizeof(int),
                        .count = static_cast<int>(pairs.size()),
                        .reach = static_cast<float>(enlarged)};
  return feature == Feature::edge_edge ? kernels().near_edges(paths, near.data())
                                       : kernels().near_vertices(paths, near.data());
}

}  // namespace drape
