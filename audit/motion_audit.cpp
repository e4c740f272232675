#include "audit/motion_audit.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>
#include <utility>

#include "audit/crossings.hpp"
#include "audit/passages.hpp"
#include "audit/predicates.hpp"

namespace drape::audit {

EnergyRise largest_rise(std::span<const double> energies, std::span<const double> work) {
  if (!work.empty() && work.size() + 1 != energies.size()) {
    throw std::invalid_argument(
        fmt::format("{} energies have {} steps, found work for {}", energies.size(), energies.size() - 1, work.size()));
  }
  EnergyRise largest;
  double least = std::numeric_limits<double>::infinity(), done = 0;
  int at_least = 0;
  for (std::size_t i = 0; i < energies.size(); ++i) {
    if (i > 0 && !work.empty()) done += work[i - 1];
    const double energy = energies[i] - done;
    const int state = static_cast<int>(i);
    if (!std::isfinite(energy)) return {std::numeric_limits<double>::infinity(), at_least, state};
    if (energy < least) least = energy, at_least = state;
    if (energy - least > largest.rise) largest = {energy - least, at_least, state};
  }
  return largest;
}

std::string describe(const StretchedEdge& stretched) {
  return fmt::format("cloth edge {} {} is stretched to {:.6g}", stretched.edge[0], stretched.edge[1],
                     stretched.stretch);
}

std::vector<StretchedEdge> find_stretched(const std::vector<Edge>& edges, const Vertices& rest, const Vertices& x,
                                          double limit) {
  if (rest.rows() != x.rows()) {
    throw std::invalid_argument(fmt::format("{} positions need as many at rest, found {}", x.rows(), rest.rows()));
  }
  std::vector<StretchedEdge> found;
  for (const Edge& edge : edges) {
    const auto length = [&](const Vertices& of) { return (of.row(edge[0]) - of.row(edge[1])).norm(); };
    const double now = length(x), at_rest = length(rest);
    if (now <= limit * at_rest) continue;
    const double stretch = now / at_rest;
    found.push_back({edge, stretch >= 0 ? stretch : std::numeric_limits<double>::infinity()});  // NaN is unsortable
  }
  std::ranges::sort(found, [](const StretchedEdge& a, const StretchedEdge& b) {
    return a.stretch != b.stretch ? a.stretch > b.stretch : a.edge < b.edge;
  });
  return found;
}

namespace {

constexpr double no_motion = 1e-9;  // relative to the mean edge
constexpr double fallen = 0.25;     // relative to an edge
constexpr double near = 0.5;        // relative to the mean edge
constexpr int fewest_steps = 2;

double distance_to(const std::vector<Triangle>& triangles, const Vertices& corners, const Eigen::Vector3d& p,
                   int but_of_vertex) {
  double square = HUGE_VAL;
  for (const Triangle& t : triangles) {
    if (std::ranges::find(t, but_of_vertex) != t.end()) continue;
    square = std::min(square, square_distance(p, {corners.row(t[0]).transpose(), corners.row(t[1]).transpose(),
                                                  corners.row(t[2]).transpose()}));
  }
  return std::sqrt(square);
}

/// Returns the gap between a point and a collider's contact layer, negative inside [m].
double gap_to(const Collider& collider, const Eigen::Vector3d& p) {
  if (const auto* sphere = std::get_if<SphereShape>(&collider)) {
    return (p - sphere->center).norm() - std::max(sphere->radius, sphere->reach);
  }
  if (const auto* ground = std::get_if<GroundShape>(&collider)) {
    return ground->normal.dot(p) - ground->height - ground->thickness;
  }
  const auto& mesh = std::get<MeshShape>(collider);
  return distance_to(*mesh.triangles, mesh.positions, p, -1) - mesh.thickness;
}

}  // namespace

StuckWatch::StuckWatch(const Topology& cloth, const Vertices& rest, const Held& held, Eigen::Vector3d down)
    : cloth_(cloth), held_known_(held.known), down_(std::move(down)) {
  const auto count = static_cast<std::size_t>(rest.rows());
  for (const auto& [a, b] : cloth.edges) mean_edge_ += (rest.row(a) - rest.row(b)).norm();
  mean_edge_ /= std::max<double>(1, static_cast<double>(cloth.edges.size()));
  held_.assign(count, held.known ? 0 : 1);
  for (const int v : held.vertices) held_.at(static_cast<std::size_t>(v)) = 1;
  still_.assign(count, 0);
  fall_.assign(count, 0);
}

std::vector<int> StuckWatch::add(const Vertices& x, const std::vector<Collider>& colliders) {
  std::vector<int> found;
  if (before_.rows() != x.rows()) {
    before_ = x;
    return found;
  }
  const Eigen::VectorXd drop = (x - before_) * down_;
  for (int v = 0; v < x.rows(); ++v) {
    const auto k = static_cast<std::size_t>(v);
    if ((x.row(v) - before_.row(v)).cwiseAbs().maxCoeff() <= no_motion * mean_edge_) {
      ++still_[k];
      continue;
    }
    still_[k] = 0;
    fall_[k] = 0;
    if (!held_known_) held_[k] = 0;
  }
  std::vector<double> most(still_.size(), 0);
  for (const auto& [a, b] : cloth_.edges) {
    const double length = (before_.row(a) - before_.row(b)).norm();
    if (!(length > 0)) continue;
    for (const auto& [v, other] : {std::pair(a, b), std::pair(b, a)}) {
      double& of = most[static_cast<std::size_t>(v)];
      of = std::max(of, drop[other] / length);
    }
  }
  before_ = x;
  for (int v = 0; v < x.rows(); ++v) {
    const auto k = static_cast<std::size_t>(v);
    if (still_[k] == 0) continue;
    fall_[k] += most[k];
    if (still_[k] < fewest_steps || fall_[k] < fallen || held_[k] != 0 || supported(v, x, colliders)) continue;
    found.push_back(v);
  }
  return found;
}

bool StuckWatch::supported(int vertex, const Vertices& x, const std::vector<Collider>& colliders) const {
  const Eigen::Vector3d p = x.row(vertex).transpose();
  const double reach = near * mean_edge_;
  return std::ranges::any_of(colliders, [&](const Collider& c) { return gap_to(c, p) <= reach; }) ||
         distance_to(cloth_.triangles, x, p, vertex) <= reach;
}

namespace {

/// Returns the triangles of a mesh at an edge.
std::vector<Triangle> triangles_at(const Topology& mesh, const Edge& edge) {
  std::vector<Triangle> found;
  for (const Triangle& t : mesh.triangles) {
    if (std::ranges::find(t, edge[0]) != t.end() && std::ranges::find(t, edge[1]) != t.end()) found.push_back(t);
  }
  return found;
}

/// A set of the cloth's vertices, ascending.
class Marked {
 public:
  template <class Vertices>
  void add(Owner owner, const Vertices& vertices) {
    if (owner == Owner::cloth) marked_.insert(std::begin(vertices), std::end(vertices));
  }
  [[nodiscard]] std::vector<int> all() const { return {marked_.begin(), marked_.end()}; }

 private:
  std::set<int> marked_;
};

/// Counts the pairs of triangles where an edge of one crosses the other, each once.
/// @param other the body, or the cloth itself
std::size_t count_pairs(const std::vector<Crossing>& crossings, const Topology& cloth, const Topology& other) {
  std::set<std::pair<Triangle, Triangle>> pairs;
  for (const Crossing& crossing : crossings) {
    const bool of_body = crossing.edge_owner == Owner::body;
    for (const Triangle& at : triangles_at(of_body ? other : cloth, crossing.edge)) {
      std::pair<Triangle, Triangle> pair(at, crossing.triangle);
      const bool one_mesh = crossing.edge_owner == crossing.triangle_owner;
      if (of_body || (one_mesh && pair.second < pair.first)) std::swap(pair.first, pair.second);
      pairs.insert(pair);
    }
  }
  return pairs.size();
}

}  // namespace

MotionAudit::MotionAudit(AuditedCloth cloth, const AuditLimits& limits)
    : cloth_(std::move(cloth)),
      limits_(limits),
      topology_(std::make_unique<const Topology>(make_topology(cloth_.triangles, cloth_.sewn))),
      stuck_(*topology_, cloth_.rest, cloth_.held, cloth_.down) {
  for (const Triangle& triangle : cloth_.triangles) {
    if (std::ranges::max(triangle) < cloth_.rest.rows()) continue;
    throw std::invalid_argument(
        fmt::format("a triangle names vertex {}, and there are {}", std::ranges::max(triangle), cloth_.rest.rows()));
  }
}

void MotionAudit::add(const MotionState& state) {
  if (state.x.rows() != cloth_.rest.rows()) {
    throw std::invalid_argument(
        fmt::format("a state has {} vertices, and the cloth {}", state.x.rows(), cloth_.rest.rows()));
  }
  if (states_ == 0) {
    touches_.resize(1 + state.colliders.size());
    for (const Collider& collider : state.colliders) {
      const auto* body = std::get_if<MeshShape>(&collider);
      bodies_.push_back(body != nullptr ? make_topology(*body->triangles) : Topology{});
      closed_.push_back(static_cast<char>(body != nullptr && is_closed(*body->triangles)));
    }
  }
  note(Check::crossings, state, crossings(state));
  if (states_ > 0) note(Check::ways, state, ways(state));
  note(Check::inside, state, inside(state));
  note(Check::stretch, state, stretched(state));
  const std::vector<int> stuck = stuck_.add(state.x, state.colliders);
  std::string text = stuck.empty() ? "" : fmt::format("cloth vertex {} stands still while others fall", stuck.front());
  note(Check::stuck, state, {stuck.size(), static_cast<double>(stuck.size()), std::move(text), stuck});
  ++states_;
  before_ = state.x;
  colliders_before_ = state.colliders;
}

bool MotionAudit::clean() const {
  return std::ranges::all_of(found_, [](const CheckFindings& of) { return of.states == 0; });
}

void MotionAudit::note(Check check, const MotionState& state, Finding finding) {
  if (finding.count == 0) return;
  CheckFindings& all = found_[static_cast<std::size_t>(check)];
  if (all.states++ == 0) {
    all.first = state.step;
    all.first_time = state.time;
  } else if (finding.value <= all.worst.value) {
    return;
  }
  all.worst = {
      state.step, state.time,     finding.count, finding.value, std::move(finding.text), std::move(finding.vertices),
      state.x,    state.colliders};
}

MotionAudit::Finding MotionAudit::crossings(const MotionState& state) const {
  Finding finding;
  Marked marked;
  const auto take = [&](const std::vector<Crossing>& found, const Topology& other) {
    finding.count += count_pairs(found, *topology_, other);
    for (const Crossing& crossing : found) {
      if (finding.text.empty()) finding.text = describe(crossing);
      marked.add(crossing.edge_owner, crossing.edge);
      marked.add(crossing.triangle_owner, crossing.triangle);
    }
  };
  const Surface cloth{*topology_, state.x};
  take(find_crossings(cloth), *topology_);
  for (std::size_t i = 0; i < state.colliders.size(); ++i) {
    const auto* body = std::get_if<MeshShape>(&state.colliders[i]);
    if (body != nullptr) take(find_crossings(cloth, {bodies_[i], body->positions}), bodies_[i]);
  }
  finding.value = static_cast<double>(finding.count);
  finding.vertices = marked.all();
  return finding;
}

MotionAudit::Finding MotionAudit::ways(const MotionState& state) {
  Finding finding;
  Marked marked;
  const auto take = [&](const std::vector<Passage>& found) {
    for (const Passage& passage : found) {
      if (passage.touch) {
        ++found_[static_cast<std::size_t>(Check::ways)].touches;
        continue;
      }
      ++finding.count;
      if (finding.text.empty()) finding.text = describe(passage);
      const auto middle = passage.vertices.begin() + (passage.kind == Passage::Kind::vertex_triangle ? 1 : 2);
      marked.add(passage.first_owner, std::vector<int>(passage.vertices.begin(), middle));
      marked.add(passage.second_owner, std::vector<int>(middle, passage.vertices.end()));
    }
  };
  const SurfaceMotion cloth{*topology_, before_, state.x};
  take(find_passages(cloth, &touches_.front()));
  for (std::size_t i = 0; i < state.colliders.size(); ++i) {
    const auto* body = std::get_if<MeshShape>(&state.colliders[i]);
    if (body == nullptr) continue;
    take(find_passages(cloth, {bodies_[i], std::get<MeshShape>(colliders_before_.at(i)).positions, body->positions},
                       &touches_.at(i + 1)));
  }
  finding.value = static_cast<double>(finding.count);
  finding.vertices = marked.all();
  return finding;
}

MotionAudit::Finding MotionAudit::inside(const MotionState& state) {
  Finding finding;
  double& largest = found_[static_cast<std::size_t>(Check::inside)].largest;
  const auto take = [&](const std::vector<Inside>& found) {
    for (const Inside& one : found) {
      largest = std::max(largest, one.depth);
      if (one.depth <= limits_.depth) continue;
      ++finding.count;
      finding.vertices.push_back(one.vertex);
      if (one.depth > finding.value) {
        finding.value = one.depth;
        finding.text = describe(one);
      }
    }
  };
  for (std::size_t i = 0; i < state.colliders.size(); ++i) {
    if (const auto* body = std::get_if<MeshShape>(&state.colliders[i])) {
      if (closed_[i] != 0) take(find_inside(state.x, {bodies_[i], body->positions}));
    } else if (const auto* sphere = std::get_if<SphereShape>(&state.colliders[i])) {
      take(find_inside_sphere(state.x, sphere->center, sphere->radius));
    } else if (const auto* ground = std::get_if<GroundShape>(&state.colliders[i])) {
      take(find_behind_plane(state.x, ground->height * ground->normal, ground->normal));
    }
  }
  std::ranges::sort(finding.vertices);
  return finding;
}

MotionAudit::Finding MotionAudit::stretched(const MotionState& state) {
  Finding finding;
  double& largest = found_[static_cast<std::size_t>(Check::stretch)].largest;
  for (const auto& [a, b] : topology_->edges) {
    const double rest = (cloth_.rest.row(a) - cloth_.rest.row(b)).norm();
    const double length = (state.x.row(a) - state.x.row(b)).norm();
    if (length > 0) largest = std::max(largest, length / rest);  // infinite for a rest length of zero
  }
  const std::vector<StretchedEdge> found = find_stretched(topology_->edges, cloth_.rest, state.x, limits_.stretch);
  if (found.empty()) return finding;
  Marked marked;
  for (const StretchedEdge& one : found) marked.add(Owner::cloth, one.edge);
  return {found.size(), found.front().stretch, describe(found.front()), marked.all()};
}

}  // namespace drape::audit
