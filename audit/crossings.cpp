#include "audit/crossings.hpp"

#include <fmt/format.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <stdexcept>
#include <tuple>

#include "audit/box_tree.hpp"
#include "audit/passages.hpp"
#include "audit/predicates.hpp"
#include "audit/touches.hpp"

namespace drape::audit {
namespace {

Eigen::Vector3d point(const Vertices& x, int vertex) { return x.row(vertex).transpose(); }

void add_crossings(const Surface& edges, Owner edge_owner, const Surface& triangles, Owner triangle_owner,
                   std::vector<Crossing>& found) {
  const bool one_mesh = edge_owner == triangle_owner;
  const BoxTree edge_tree(boxes_around(edges.topology.edges, {&edges.x}));
  const BoxTree triangle_tree(boxes_around(triangles.topology.triangles, {&triangles.x}));
  edge_tree.for_pairs_with(triangle_tree, [&](int e, int t) {
    const Edge& edge = edges.topology.edges[static_cast<std::size_t>(e)];
    const Triangle& triangle = triangles.topology.triangles[static_cast<std::size_t>(t)];
    if (one_mesh && share_vertex(edges.topology, edge, triangle)) return;
    if (goes_through(
            {point(edges.x, edge[0]), point(edges.x, edge[1])},
            {point(triangles.x, triangle[0]), point(triangles.x, triangle[1]), point(triangles.x, triangle[2])})) {
      found.push_back({edge_owner, edge, triangle_owner, triangle});
    }
  });
}

/// Returns the triangles that contain each vertex exactly, without those that share a vertex with it.
std::map<int, std::vector<int>> triangles_under(const Surface& vertices, const Surface& triangles, bool one_mesh) {
  std::vector<std::array<int, 1>> all(static_cast<std::size_t>(vertices.x.rows()));
  for (std::size_t v = 0; v < all.size(); ++v) all[v] = {static_cast<int>(v)};
  std::map<int, std::vector<int>> under;
  const BoxTree vertex_tree(boxes_around(all, {&vertices.x}));
  vertex_tree.for_pairs_with(BoxTree(boxes_around(triangles.topology.triangles, {&triangles.x})), [&](int v, int t) {
    const Triangle& triangle = triangles.topology.triangles[static_cast<std::size_t>(t)];
    if (one_mesh && share_vertex(vertices.topology, std::array{v}, triangle)) return;
    const Eigen::Vector3d p = point(vertices.x, v), a = point(triangles.x, triangle[0]),
                          b = point(triangles.x, triangle[1]), c = point(triangles.x, triangle[2]);
    if (orientation(a, b, c, p) != 0) return;
    if (vertex_meets_triangle({p, p}, {Way{a, a}, Way{b, b}, Way{c, c}})) under[v].push_back(t);
  });
  return under;
}

/// Finds crossings between triangles at a displaced vertex and triangles that contain the vertex.
class CrossingsAtVertex {
 public:
  CrossingsAtVertex(const Surface& vertices, Owner owner, const Surface& others, Owner other_owner)
      : own_(vertices),
        others_(others),
        owner_(owner),
        other_owner_(other_owner),
        at_vertices_(triangles_at_vertices(vertices.topology, vertices.x.rows())),
        length_(displacement(vertices.x, others.x)) {}

  [[nodiscard]] std::vector<Crossing> find(int vertex, const std::vector<int>& others, int towards) const {
    const Eigen::Vector3d moved = length_ * direction(towards);
    std::vector<Crossing> found;
    for (const int i : at_vertices_[static_cast<std::size_t>(vertex)]) {
      const Triangle& own = own_.topology.triangles[static_cast<std::size_t>(i)];
      for (const int j : others) {
        const Triangle& other = others_.topology.triangles[static_cast<std::size_t>(j)];
        for (std::size_t k = 0; k < 3; ++k) {
          const Edge spoke = sorted(own[k], own[(k + 1) % 3]), side = sorted(other[k], other[(k + 1) % 3]);
          if ((spoke[0] == vertex || spoke[1] == vertex) && !shared(spoke, other) &&
              goes_through(corners(own_, spoke, moved), corners(others_, other, Eigen::Vector3d::Zero()))) {
            found.push_back({owner_, spoke, other_owner_, other});
          }
          if (!shared(side, own) &&
              goes_through(corners(others_, side, Eigen::Vector3d::Zero()), corners(own_, own, moved))) {
            found.push_back({other_owner_, side, owner_, own});
          }
        }
      }
    }
    return found;
  }

 private:
  static Edge sorted(int a, int b) { return {std::min(a, b), std::max(a, b)}; }
  template <std::size_t count>
  static std::array<Eigen::Vector3d, count> corners(const Surface& of, const std::array<int, count>& feature,
                                                    const Eigen::Vector3d& moved) {
    std::array<Eigen::Vector3d, count> at;
    std::ranges::transform(feature, at.begin(), [&](int v) -> Eigen::Vector3d { return point(of.x, v) + moved; });
    return at;
  }
  [[nodiscard]] bool shared(const Edge& edge, const Triangle& triangle) const {
    return owner_ == other_owner_ && share_vertex(own_.topology, edge, triangle);
  }

  const Surface &own_, &others_;
  Owner owner_, other_owner_;
  std::vector<std::vector<int>> at_vertices_;
  double length_;
};

/// Adds crossings at vertices that lie exactly on triangles. There is one if the triangles at the vertex cross the
/// others wherever they are displaced a little.
void add_crossings_at_vertices(const Surface& vertices, Owner owner, const Surface& others, Owner other_owner,
                               std::vector<Crossing>& found) {
  const std::map<int, std::vector<int>> under = triangles_under(vertices, others, owner == other_owner);
  if (under.empty()) return;
  const CrossingsAtVertex finder(vertices, owner, others, other_owner);
  for (const auto& [vertex, triangles] : under) {
    // One fixed displacement of the cloth against a body, and of lower vertices against higher ones.
    const Triangle& other = others.topology.triangles[static_cast<std::size_t>(triangles.front())];
    const bool forwards = owner == other_owner ? vertex < std::ranges::min(other) : owner == Owner::cloth;
    const std::vector<Crossing> chosen = finder.find(vertex, triangles, forwards ? 0 : 1);
    bool everywhere = true;
    for (int k = 0; everywhere && k < direction_count; ++k) everywhere = !finder.find(vertex, triangles, k).empty();
    if (everywhere) found.insert(found.end(), chosen.begin(), chosen.end());
  }
}

}  // namespace

std::string describe(const Crossing& crossing) {
  return fmt::format("{} goes through {}", describe(crossing.edge_owner, {crossing.edge.begin(), crossing.edge.end()}),
                     describe(crossing.triangle_owner, {crossing.triangle.begin(), crossing.triangle.end()}));
}

void sort(std::vector<Crossing>& crossings) {
  std::ranges::sort(crossings, {},
                    [](const Crossing& c) { return std::tuple(c.edge_owner, c.edge, c.triangle_owner, c.triangle); });
  crossings.erase(std::unique(crossings.begin(), crossings.end()), crossings.end());
}

bool goes_through(const std::array<Eigen::Vector3d, 2>& edge, const std::array<Eigen::Vector3d, 3>& triangle) {
  const auto& [p, q] = edge;
  const auto& [a, b, c] = triangle;
  const int side = orientation(a, b, c, p);
  if (side == 0 || orientation(a, b, c, q) != -side) return false;
  const int ab = orientation(p, q, a, b), bc = orientation(p, q, b, c), ca = orientation(p, q, c, a);
  return ab * bc >= 0 && bc * ca >= 0 && ca * ab >= 0;
}

std::vector<Crossing> find_crossings(const Surface& cloth) {
  check_vertices(cloth.topology.triangles, cloth.x);
  const Vertices x = exact_positions(cloth.x);
  const Surface exact{cloth.topology, x};
  std::vector<Crossing> found;
  add_crossings(exact, Owner::cloth, exact, Owner::cloth, found);
  add_crossings_at_vertices(exact, Owner::cloth, exact, Owner::cloth, found);
  sort(found);
  return found;
}

std::vector<Crossing> find_crossings(const Surface& cloth, const Surface& body) {
  check_vertices(cloth.topology.triangles, cloth.x);
  check_vertices(body.topology.triangles, body.x);
  const Vertices cloth_x = exact_positions(cloth.x), body_x = exact_positions(body.x);
  const Surface exact_cloth{cloth.topology, cloth_x}, exact_body{body.topology, body_x};
  std::vector<Crossing> found;
  add_crossings(exact_cloth, Owner::cloth, exact_body, Owner::body, found);
  add_crossings(exact_body, Owner::body, exact_cloth, Owner::cloth, found);
  add_crossings_at_vertices(exact_cloth, Owner::cloth, exact_body, Owner::body, found);
  add_crossings_at_vertices(exact_body, Owner::body, exact_cloth, Owner::cloth, found);
  sort(found);
  return found;
}

namespace {

using Point = Eigen::Vector3d;
using Corners = std::array<Point, 3>;

void deepest_first(std::vector<Inside>& found) {
  std::ranges::sort(found, [](const Inside& a, const Inside& b) {
    return a.depth != b.depth ? a.depth > b.depth : a.vertex < b.vertex;
  });
}

/// A closed mesh with exact winding numbers.
class Solid {
 public:
  explicit Solid(const Surface& body) : x_(exact_positions(body.x)) {
    const std::vector<Triangle>& triangles = body.topology.triangles;
    for (const auto& [a, b, c] : triangles) {
      corners_.push_back({x_.row(a).transpose(), x_.row(b).transpose(), x_.row(c).transpose()});
    }
    boxes_ = boxes_around(triangles, {&x_});
    bounds_ = boxes_.front();
    for (const Box& box : boxes_) bounds_.include(box);
  }

  [[nodiscard]] bool contains(const Point& p) const {
    if (!bounds_.meets({p.array(), p.array()})) return false;
    for (int attempt = 1; attempt <= 20; ++attempt) {
      const std::optional<int> winding = winding_along(p, outside_point(p, attempt));
      if (winding) return *winding != 0;
    }
    return false;  // every attempt failed: rays in any direction start on a triangle
  }

  [[nodiscard]] double distance(const Point& p) const {
    double square = std::numeric_limits<double>::infinity();
    for (const Corners& triangle : corners_) square = std::min(square, square_distance(p, triangle));
    return std::sqrt(square);
  }

 private:
  /// Returns a point beyond the solid along x, in another direction for each attempt. The ray's box is thin in y and z,
  /// so it meets few triangles; its slopes match no symmetry of meshes.
  [[nodiscard]] Point outside_point(const Point& p, int attempt) const {
    const double size = (bounds_.high - bounds_.low).maxCoeff();
    return {bounds_.high[0] + size, p[1] + 0.01378 * attempt * size, p[2] - 0.02137 / attempt * size};
  }

  /// Returns the signed number of triangles that the segment pq crosses; nothing if it meets a boundary or starts on a
  /// triangle.
  [[nodiscard]] std::optional<int> winding_along(const Point& p, const Point& q) const {
    const Box ray{p.array().min(q.array()), p.array().max(q.array())};
    int winding = 0;
    for (std::size_t t = 0; t < corners_.size(); ++t) {
      if (!boxes_[t].meets(ray)) continue;
      const auto& [a, b, c] = corners_[t];
      const int ab = orientation(p, q, a, b), bc = orientation(p, q, b, c), ca = orientation(p, q, c, a);
      if (ab * bc < 0 || bc * ca < 0 || ca * ab < 0) continue;
      const int side_p = orientation(a, b, c, p), side_q = orientation(a, b, c, q);
      if (side_p * side_q > 0) continue;
      if (ab * bc * ca * side_p * side_q == 0) return std::nullopt;
      winding += side_p;
    }
    return winding;
  }

  Vertices x_;
  std::vector<Corners> corners_;
  std::vector<Box> boxes_;
  Box bounds_;
};

}  // namespace

std::string describe(const Inside& inside) {
  return fmt::format("cloth vertex {} is {:.4g} mm deep inside", inside.vertex, 1e3 * inside.depth);
}

bool is_closed(const std::vector<Triangle>& triangles) {
  std::map<Edge, int> turns;
  for (const Triangle& triangle : triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const int a = triangle[i], b = triangle[(i + 1) % 3];
      turns[{std::min(a, b), std::max(a, b)}] += a < b ? 1 : -1;
    }
  }
  return !triangles.empty() && std::ranges::all_of(turns, [](const auto& turn) { return turn.second == 0; });
}

std::vector<Inside> find_inside(const Vertices& cloth, const Surface& body) {
  check_vertices(body.topology.triangles, body.x);
  if (!is_closed(body.topology.triangles)) throw std::invalid_argument("only a closed mesh has an inside");
  const Solid solid(body);
  const Vertices x = exact_positions(cloth);
  std::vector<Inside> found;
  for (int v = 0; v < x.rows(); ++v) {
    const Point p = x.row(v).transpose();
    if (solid.contains(p)) found.push_back({v, solid.distance(p)});
  }
  deepest_first(found);
  return found;
}

std::vector<Inside> find_inside_sphere(const Vertices& cloth, const Eigen::Vector3d& center, double radius) {
  std::vector<Inside> found;
  for (int v = 0; v < cloth.rows(); ++v) {
    const double depth = radius - (cloth.row(v).transpose() - center).norm();
    if (!(depth <= 0)) found.push_back({v, depth});
  }
  deepest_first(found);
  return found;
}

std::vector<Inside> find_behind_plane(const Vertices& cloth, const Eigen::Vector3d& point,
                                      const Eigen::Vector3d& normal) {
  std::vector<Inside> found;
  for (int v = 0; v < cloth.rows(); ++v) {
    const double depth = -normal.dot(cloth.row(v).transpose() - point);
    if (!(depth <= 0)) found.push_back({v, depth});
  }
  deepest_first(found);
  return found;
}

Topology make_topology(std::vector<Triangle> triangles, std::vector<Edge> sewn) {
  for (const auto& [a, b, c] : triangles) {
    if (std::min({a, b, c}) < 0 || a == b || b == c || c == a) {
      throw std::invalid_argument(fmt::format("a triangle needs three different vertices, found {} {} {}", a, b, c));
    }
  }
  std::vector<Edge> edges = unique_edges(triangles);
  return {std::move(triangles), std::move(edges), std::move(sewn)};
}

std::vector<Edge> sewn_vertices(const std::vector<Seam>& seams) {
  std::vector<Edge> pairs;
  for (const Seam& seam : seams) {
    for (const SeamTie& tie : seam.ties) {
      for (const int other : tie.edge) pairs.push_back({std::min(tie.vertex, other), std::max(tie.vertex, other)});
    }
  }
  std::ranges::sort(pairs);
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

std::string describe(Owner owner, std::vector<int> vertices) {
  static constexpr std::array<const char*, 3> names{"vertex", "edge", "triangle"};
  return fmt::format("{} {} {}", owner == Owner::cloth ? "cloth" : "body", names.at(vertices.size() - 1),
                     fmt::join(vertices, " "));
}

}  // namespace drape::audit
