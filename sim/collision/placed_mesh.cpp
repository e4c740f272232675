#include "sim/collision/placed_mesh.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "sim/bending/bending_energy.hpp"

namespace drape {
namespace {

using Index = std::size_t;

// Least ratio of a triangle's area to its squared longest edge, both doubled; below, it counts as its edges.
constexpr double least_placed_area = 1e-8;
// The sum of two unit normals at an edge is shorter than this if the edge turns by more than 150°.
constexpr double sharpest_fold = 0.5;

}  // namespace

MeshTopology::MeshTopology(const std::vector<Triangle>& all, int vertex_count) {
  for (const Triangle& t : all) {
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) triangles.push_back(t);
  }
  across.assign(triangles.size(), {-1, -1, -1});
  const std::vector<EdgeSide> sides = edge_sides(triangles);
  const auto start_of = [&](const EdgeSide& side) -> Index {  // the corner at which the edge begins
    const Triangle& t = triangles[Index(side.triangle)];
    return side.opposite == t[0] ? 1 : side.opposite == t[1] ? 2 : 0;
  };
  const auto forwards = [&](const EdgeSide& side) {
    return triangles[Index(side.triangle)][start_of(side)] == side.edge[0];
  };
  closed = !triangles.empty();
  for (Index first = 0, last = 0; first < sides.size(); first = last) {
    while (last < sides.size() && sides[last].edge == sides[first].edge) ++last;
    const EdgeSide &a = sides[first], &b = sides[last - 1];
    if (last - first == 2) {
      across[Index(a.triangle)][start_of(a)] = b.triangle;
      across[Index(b.triangle)][start_of(b)] = a.triangle;
    }
    closed = closed && last - first == 2 && forwards(a) != forwards(b);
  }
  around = Incidence(triangles, vertex_count);
}

PlacedMesh::PlacedMesh(std::shared_ptr<const MeshTopology> topology, const Vertices& x, double travel)
    : topology_(std::move(topology)),
      points_(Index(x.rows())),
      normals_(topology_->triangles.size()),
      facets_(topology_->triangles.size()),
      boxes_(topology_->triangles.size()),
      travel_(travel) {
  update(x);
  tree_.build(boxes_);
}

void PlacedMesh::place(const Vertices& x, double travel) {
  travel_ = travel;
  update(x);
  tree_.refit(boxes_);
}

void PlacedMesh::update(const Vertices& x) {
  for (Eigen::Index i = 0; i < x.rows(); ++i) points_[Index(i)] = x.row(i).transpose();
  double volume = 0;
  const Point origin = points_.empty() ? Point(Point::Zero()) : points_.front();
  for (Index t = 0; t < normals_.size(); ++t) {
    const Triangle& corners = topology_->triangles[t];
    const Point &a = points_[Index(corners[0])], &b = points_[Index(corners[1])], &c = points_[Index(corners[2])];
    boxes_[t] = Box(a).extend(b).extend(c);
    const Point ab = b - a, ac = c - a, area = ab.cross(ac);
    volume += area.dot(a - origin);
    const double length = area.norm(), inverse = length > 0 ? 1 / length : 0;
    normals_[t] = inverse * area;
    const double longest = std::max({ab.squaredNorm(), ac.squaredNorm(), (c - b).squaredNorm()});
    const bool flat = length <= least_placed_area * longest;
    const double scale = flat ? std::numeric_limits<double>::quiet_NaN() : inverse * inverse;
    const Point second = scale * ac.cross(area), third = scale * area.cross(ab);
    facets_[t] = {a,
                  flat ? Point(Point::Zero()) : normals_[t],
                  second,
                  third,
                  {1 / (second + third).squaredNorm(), 1 / second.squaredNorm(), 1 / third.squaredNorm()}};
  }
  if (solid() && volume < 0) {
    for (Point& normal : normals_) normal = -normal;
    for (Facet& facet : facets_) facet.normal = -facet.normal;
  }
}

Point PlacedMesh::normal_at(int triangle, const Point& weights) const {
  const Triangle& corners = topology_->triangles[Index(triangle)];
  const auto zeros = (weights.array() == 0).count();
  if (zeros == 0) return normals_[Index(triangle)];
  if (zeros == 1) {
    // The opposite edge begins after the corner of zero weight.
    const Index from = weights[0] == 0 ? 1 : weights[1] == 0 ? 2 : 0;
    const int other = topology_->across[Index(triangle)][from];
    return normals_[Index(triangle)] + (other < 0 ? Point(Point::Zero()) : normals_[Index(other)]);
  }
  const Index own = weights[0] != 0 ? 0 : weights[1] != 0 ? 1 : 2;
  const int vertex = corners[own];
  Point sum = Point::Zero();
  for (const int t : topology_->around.of(vertex)) {
    const Triangle& triple = topology_->triangles[Index(t)];
    const Index at = triple[0] == vertex ? 0 : triple[1] == vertex ? 1 : 2;
    const Point ahead = corner(t, (at + 1) % 3) - corner(t, at), behind = corner(t, (at + 2) % 3) - corner(t, at);
    sum += std::atan2(ahead.cross(behind).norm(), ahead.dot(behind)) * normals_[Index(t)];
  }
  return sum;
}

bool PlacedMesh::encloses(const Point& point) const {
  double solid_angle = 0;
  for (Index t = 0; t < normals_.size(); ++t) {
    const auto to = [&](std::size_t c) { return Point(corner(static_cast<int>(t), c) - point); };
    const Point a = to(0), b = to(1), c = to(2);
    const double l = a.norm(), m = b.norm(), n = c.norm();
    solid_angle += 2 * std::atan2(a.dot(b.cross(c)), l * m * n + a.dot(b) * n + b.dot(c) * l + c.dot(a) * m);
  }
  return std::abs(solid_angle) > 2 * std::numbers::pi;
}

ClosestPoint PlacedMesh::foot_on_edge(const Point& point, int triangle, const Nearest& near) const {
  ClosestPoint closest{.triangle = triangle, .weights = {-near.weights[1], -near.weights[2], -near.weights[3]}};
  const Point away = point - closest.weights[0] * corner(triangle, 0) - closest.weights[1] * corner(triangle, 1) -
                     closest.weights[2] * corner(triangle, 2);
  const Point out = normal_at(triangle, closest.weights);
  // Normals are useless where a mesh folds onto itself, as skin may at an elbow.
  const bool folded = solid() && out.squaredNorm() < sharpest_fold * sharpest_fold;
  const bool inside = folded ? encloses(point) : out.dot(away) < 0;
  const double length = std::sqrt(near.squared);
  closest.distance = inside ? -length : length;
  closest.normal = length > 0 ? Point(away / closest.distance) : Point(out.stableNormalized());
  return on_its_side(closest);
}

std::optional<ClosestPoint> PlacedMesh::find(const Point& point, double reach, int hint) const {
  const Box& bounds = tree_.bounds();
  if (!((point - bounds.min()).array() >= -reach).all() || !((bounds.max() - point).array() >= -reach).all()) {
    return std::nullopt;
  }
  double limit = solid() ? std::numeric_limits<double>::infinity() : reach * reach;
  Nearest best{};
  int found = -1;
  const auto look_at = [&](int t) {
    if (least_squared(t, point) > limit) return;
    const Nearest near = nearest_on(t, point);
    if (!(near.squared < limit || (near.squared == limit && (found < 0 || t < found)))) return;
    best = near;
    found = t;
    limit = near.squared;
  };
  if (hint >= 0) look_at(hint);
  tree_.for_nearest(point, limit, look_at);
  if (found < 0) return std::nullopt;
  return closest_point(point, found, best);
}

MovingBody::MovingBody(std::shared_ptr<const MeshMotion> shape, RigidMotion motion)
    : shape_(std::move(shape)),
      motion_(std::move(motion)),
      topology_(
          std::make_shared<MeshTopology>(shape_->mesh.triangles, static_cast<int>(shape_->mesh.positions.rows()))) {}

std::shared_ptr<const PlacedMesh> MovingBody::mesh_at(double time) const {
  const auto known = std::ranges::find_if(shapes_, [&](const Shape& s) { return !deforms() || s.time == time; });
  if (known != shapes_.end()) {
    std::rotate(known, known + 1, shapes_.end());
    return shapes_.back().mesh;
  }
  shape_->place(time, scratch_);
  if (last_.rows() == scratch_.rows()) travel_ += std::sqrt((scratch_ - last_).rowwise().squaredNorm().maxCoeff());
  last_.swap(scratch_);
  // Keep the shapes of two times, as a step uses its start and end; reuse others that are not referenced.
  const auto last = shapes_.end() - std::min<std::ptrdiff_t>(2, std::ssize(shapes_));
  const auto idle = std::find_if(shapes_.begin(), last, [](const Shape& s) { return s.mesh.use_count() == 1; });
  if (idle == last) {
    shapes_.push_back({time, std::make_shared<PlacedMesh>(topology_, last_, travel_)});
  } else {
    idle->time = time;
    idle->mesh->place(last_, travel_);
    std::rotate(idle, idle + 1, shapes_.end());
  }
  return shapes_.back().mesh;
}

Vertices MovingBody::positions(double time) const {
  Vertices x;
  shape_->place(time, x);
  const Pose pose = motion_.at(time);
  return (x * pose.rotation.transpose()).rowwise() + pose.position.transpose();
}

}  // namespace drape
