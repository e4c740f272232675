#include "audit/passages.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <tuple>

#include "audit/boxes.hpp"
#include "audit/meeting.hpp"

namespace drape::audit {
namespace {

/// A mesh in a step, with positions for exact predicates and its broad phase.
struct Swept {
  Owner owner;
  const Topology& topology;
  Vertices from, to;
  BoxTree vertices, edges, triangles;

  [[nodiscard]] Way way(int v) const { return {from.row(v).transpose(), to.row(v).transpose()}; }
};

/// Returns the mean displacement of all vertices.
Eigen::RowVector3d common_way(const SurfaceMotion& motion) {
  if (motion.from.rows() == 0 || motion.from.rows() != motion.to.rows()) return Eigen::RowVector3d::Zero();
  return motion.to.colwise().mean() - motion.from.colwise().mean();
}

/// @param common displacement of the frame in which boxes are swept, equal for both meshes: common motion sweeps no
///               volume. Boxes include the rounding errors of the frame.
Swept sweep(Owner owner, const SurfaceMotion& motion, const Eigen::RowVector3d& common) {
  if (motion.from.rows() != motion.to.rows()) {
    throw std::invalid_argument(fmt::format("a step needs as many vertices at its end as at its start, found {} and {}",
                                            motion.to.rows(), motion.from.rows()));
  }
  check_vertices(motion.topology.triangles, motion.from);
  const Vertices from = exact_positions(motion.from), to = exact_positions(motion.to);
  const Vertices relative = to.rowwise() - common;
  const Vertices below = relative.unaryExpr([](double x) { return std::nextafter(x, -HUGE_VAL); });
  const Vertices above = relative.unaryExpr([](double x) { return std::nextafter(x, HUGE_VAL); });
  std::vector<std::array<int, 1>> vertices(static_cast<std::size_t>(from.rows()));
  for (std::size_t v = 0; v < vertices.size(); ++v) vertices[v] = {static_cast<int>(v)};
  return {owner,
          motion.topology,
          from,
          to,
          BoxTree(boxes_around(vertices, {&from, &below, &above})),
          BoxTree(boxes_around(motion.topology.edges, {&from, &below, &above})),
          BoxTree(boxes_around(motion.topology.triangles, {&from, &below, &above}))};
}

void add_vertices_in_triangles(const Swept& a, const Swept& b, std::vector<Passage>& found) {
  a.vertices.for_pairs_with(b.triangles, [&](int v, int t) {
    const Triangle& triangle = b.topology.triangles[static_cast<std::size_t>(t)];
    if (&a == &b && share_vertex(std::array{v}, triangle)) return;
    const auto meeting = vertex_meets_triangle(a.way(v), {b.way(triangle[0]), b.way(triangle[1]), b.way(triangle[2])});
    if (!meeting) return;
    found.push_back({Passage::Kind::vertex_triangle,
                     a.owner,
                     b.owner,
                     {v, triangle[0], triangle[1], triangle[2]},
                     meeting->time,
                     meeting->touch});
  });
}

void add_edges(const Swept& a, const Swept& b, std::vector<Passage>& found) {
  const auto visit = [&](int i, int j) {
    const Edge& first = a.topology.edges[static_cast<std::size_t>(i)];
    const Edge& second = b.topology.edges[static_cast<std::size_t>(j)];
    if (&a == &b && share_vertex(first, second)) return;
    const auto meeting = edges_meet({a.way(first[0]), a.way(first[1])}, {b.way(second[0]), b.way(second[1])});
    if (!meeting) return;
    found.push_back({Passage::Kind::edge_edge,
                     a.owner,
                     b.owner,
                     {first[0], first[1], second[0], second[1]},
                     meeting->time,
                     meeting->touch});
  };
  if (&a == &b) {
    a.edges.for_pairs(visit);
  } else {
    a.edges.for_pairs_with(b.edges, visit);
  }
}

void sort(std::vector<Passage>& found) {
  std::ranges::sort(found, {}, [](const Passage& p) { return std::tuple(p.kind, p.first_owner, p.vertices); });
}

}  // namespace

std::string describe(const Passage& passage) {
  const std::size_t split = passage.kind == Passage::Kind::vertex_triangle ? 1 : 2;
  const auto middle = passage.vertices.begin() + static_cast<std::ptrdiff_t>(split);
  return fmt::format("{} {} {} at {:.6g} of the step",
                     describe(passage.first_owner, {passage.vertices.begin(), middle}),
                     passage.touch ? "touches" : "meets",
                     describe(passage.second_owner, {middle, passage.vertices.end()}), passage.time);
}

std::vector<Passage> find_passages(const SurfaceMotion& cloth) {
  const Swept swept = sweep(Owner::cloth, cloth, common_way(cloth));
  std::vector<Passage> found;
  add_vertices_in_triangles(swept, swept, found);
  add_edges(swept, swept, found);
  sort(found);
  return found;
}

std::vector<Passage> find_passages(const SurfaceMotion& cloth, const SurfaceMotion& body) {
  const Eigen::RowVector3d common = common_way(cloth);
  const Swept swept_cloth = sweep(Owner::cloth, cloth, common), swept_body = sweep(Owner::body, body, common);
  std::vector<Passage> found;
  add_vertices_in_triangles(swept_cloth, swept_body, found);
  add_vertices_in_triangles(swept_body, swept_cloth, found);
  add_edges(swept_cloth, swept_body, found);
  sort(found);
  return found;
}

}  // namespace drape::audit
