#include "audit/crossings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

#include "audit/boxes.hpp"
#include "audit/orientation.hpp"

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
    if (one_mesh && share_vertex(edge, triangle)) return;
    if (goes_through(
            {point(edges.x, edge[0]), point(edges.x, edge[1])},
            {point(triangles.x, triangle[0]), point(triangles.x, triangle[1]), point(triangles.x, triangle[2])})) {
      found.push_back({edge_owner, edge, triangle_owner, triangle});
    }
  });
}

}  // namespace

std::string describe(const Crossing& crossing) {
  return fmt::format("{} goes through {}", describe(crossing.edge_owner, {crossing.edge.begin(), crossing.edge.end()}),
                     describe(crossing.triangle_owner, {crossing.triangle.begin(), crossing.triangle.end()}));
}

void sort(std::vector<Crossing>& crossings) {
  std::ranges::sort(crossings, {},
                    [](const Crossing& c) { return std::tuple(c.edge_owner, c.edge, c.triangle_owner, c.triangle); });
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
  sort(found);
  return found;
}

}  // namespace drape::audit
