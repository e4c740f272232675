#include "drape/sim/body_shape.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/keys.hpp"
#include "drape/sim/tracks.hpp"

namespace drape {

std::array<Eigen::Matrix3d, 3> turns_about_axes(const Eigen::Vector3d& degrees) {
  std::array<Eigen::Matrix3d, 3> about;
  for (int axis = 0; axis < 3; ++axis) {
    about[static_cast<std::size_t>(axis)] =
        Eigen::AngleAxisd(degrees[axis] * std::numbers::pi / 180, Eigen::Vector3d::Unit(axis)).toRotationMatrix();
  }
  return about;
}

Eigen::Matrix3d turn_about_axes(const Eigen::Vector3d& degrees) {
  const auto about = turns_about_axes(degrees);
  return about[2] * about[1] * about[0];
}

RigidMotion::RigidMotion(std::shared_ptr<const SphereTrack> path, const Eigen::Matrix3d& turn,
                         std::optional<Orbit> orbit, std::optional<Keyframes> turns)
    : path_(std::move(path)), turn_(turn), orbit_(orbit), turns_(std::move(turns)) {
  if (orbit_) orbit_->axis.normalize();
}

Pose RigidMotion::at(double time) const {
  Pose pose{turn_, path_->at(time).center};
  if (turns_) pose.rotation = turn_about_axes(turns_->at(time)) * turn_;
  if (!orbit_) return pose;
  // As for the path, a whole number of periods returns exactly to the start.
  const double turns = std::remainder(time / orbit_->period, 1.0);
  if (turns != 0) pose.rotation = Eigen::AngleAxisd(2 * std::numbers::pi * turns, orbit_->axis) * pose.rotation;
  return pose;
}

void MeshMotion::place(double time, Vertices& x) const {
  if (samples.empty()) {
    x = mesh.positions;
    return;
  }
  const auto [before, after, share] = between(times, time);
  // Exactly the sample at its own time.
  x = samples[before];
  if (before != after) x += share * (samples[after] - samples[before]);
}

namespace {

/// A ring of a surface of revolution about z; a point if the radius is zero.
struct Ring {
  double radius, z;
};

/// Returns the surface through rings, from the lowest to the highest. The first and the last are points.
Mesh revolve(const std::vector<Ring>& rings, int segments) {
  const auto count = static_cast<int>(rings.size());
  Mesh mesh;
  mesh.positions.resize(2 + Eigen::Index{count - 2} * segments, 3);
  mesh.positions.row(0) << 0, 0, rings.front().z;
  mesh.positions.bottomRows(1) << 0, 0, rings.back().z;
  const auto vertex = [&](int ring, int s) { return 1 + (ring - 1) * segments + s % segments; };
  for (int r = 1; r + 1 < count; ++r) {
    const Ring& ring = rings[static_cast<std::size_t>(r)];
    for (int s = 0; s < segments; ++s) {
      const double angle = 2 * std::numbers::pi * s / segments;
      mesh.positions.row(vertex(r, s)) << ring.radius * std::cos(angle), ring.radius * std::sin(angle), ring.z;
    }
  }
  const auto last = static_cast<int>(mesh.positions.rows()) - 1;
  for (int s = 0; s < segments; ++s) {
    mesh.triangles.push_back({0, vertex(1, s + 1), vertex(1, s)});
    for (int r = 1; r + 2 < count; ++r) {
      const int a = vertex(r, s), b = vertex(r, s + 1), c = vertex(r + 1, s), d = vertex(r + 1, s + 1);
      mesh.triangles.push_back({a, b, d});
      mesh.triangles.push_back({a, d, c});
    }
    mesh.triangles.push_back({last, vertex(count - 2, s), vertex(count - 2, s + 1)});
  }
  return mesh;
}

/// Appends the rings of a sphere between two polar angles, inclusive, measured from its lower pole.
/// @param z of the sphere's centre
void add_arc(double radius, double z, double from, double to, int parts, std::vector<Ring>& rings) {
  for (int i = 0; i <= parts; ++i) {
    const double angle = from + (to - from) * i / parts;
    rings.push_back({radius * std::sin(angle), z - radius * std::cos(angle)});
  }
}

/// Appends rings along a straight part, excluding its ends, spaced by about four times the vertices' distance in a
/// ring.
void add_straight(const Ring& from, const Ring& to, int segments, std::vector<Ring>& rings) {
  const double length = std::hypot(to.radius - from.radius, to.z - from.z);
  const double apart = 2 * std::numbers::pi * std::max(from.radius, to.radius) / segments;
  constexpr double most = 1000;
  const int parts = static_cast<int>(std::clamp(std::round(length / (4 * apart)), 1.0, most));
  for (int i = 1; i < parts; ++i) {
    const double t = static_cast<double>(i) / parts;
    rings.push_back({from.radius + t * (to.radius - from.radius), from.z + t * (to.z - from.z)});
  }
}

Mesh make_plane(double width, double depth) {
  Mesh mesh;
  mesh.positions.resize(4, 3);
  mesh.positions << -width / 2, -depth / 2, 0, width / 2, -depth / 2, 0, -width / 2, depth / 2, 0, width / 2, depth / 2,
      0;
  mesh.triangles = {{0, 1, 3}, {0, 3, 2}};
  return mesh;
}

std::vector<Ring> frustum(double low, double high, double height, int segments) {
  std::vector<Ring> rings{{0, -height / 2}, {low, -height / 2}};
  const Ring foot{low, -height / 2}, top{high, height / 2};
  add_straight(foot, top, segments, rings);
  if (high > 0) rings.push_back(top);
  rings.push_back({0, height / 2});
  return rings;
}

std::vector<Ring> capsule(double radius, double height, int segments) {
  constexpr double pi = std::numbers::pi;
  const double straight = std::max(height / 2 - radius, 0.0);
  std::vector<Ring> rings;
  const int parts = std::max(segments / 4, 2);
  add_arc(radius, -straight, 0, pi / 2, parts, rings);
  if (straight > 0) {
    const Ring low{radius, -straight}, high{radius, straight};
    add_straight(low, high, segments, rings);
    rings.push_back(high);
  }
  std::vector<Ring> cap;
  add_arc(radius, straight, pi / 2, pi, parts, cap);
  rings.insert(rings.end(), cap.begin() + 1, cap.end());
  rings.front().radius = rings.back().radius = 0;
  return rings;
}

}  // namespace

const std::vector<std::string>& body_shape_names() {
  static const std::vector<std::string> names{"cylinder", "capsule", "cone", "plane", "sphere"};
  return names;
}

Keys body_shape_keys(BodyShape& shape) {
  using Kind = BodyShape::Kind;
  Keys keys;
  if (shape.kind == Kind::plane) {
    keys.add("width", &shape.width, "m", "Along x.").must_be_given().above(0);
    keys.add("depth", &shape.depth, "m", "Along y.").must_be_given().above(0);
    return keys;
  }
  keys.add("radius", &shape.radius, "m", shape.kind == Kind::cone ? "At its foot." : "Its radius.")
      .must_be_given()
      .above(0);
  if (shape.kind != Kind::sphere) {
    keys.add("height", &shape.height, "m", shape.kind == Kind::capsule ? "Along z, with both caps." : "Along z.")
        .must_be_given()
        .above(0);
  }
  if (shape.kind == Kind::cone) keys.add("top", &shape.top, "m", "Radius of its upper end.").at_least(0);
  keys.add("segments", &shape.segments, "", "Sides around its axis.").at_least(8).at_most(512);
  return keys;
}

std::optional<std::string> body_shape_problem(const BodyShape& shape) {
  if (shape.kind != BodyShape::Kind::capsule || shape.height >= 2 * shape.radius) return std::nullopt;
  return "a capsule is at least as high as both of its caps, twice its radius";
}

Mesh make_body_shape(const BodyShape& shape) {
  switch (shape.kind) {
    case BodyShape::Kind::plane:
      return make_plane(shape.width, shape.depth);
    case BodyShape::Kind::cylinder:
      return revolve(frustum(shape.radius, shape.radius, shape.height, shape.segments), shape.segments);
    case BodyShape::Kind::cone:
      return revolve(frustum(shape.radius, shape.top, shape.height, shape.segments), shape.segments);
    case BodyShape::Kind::capsule:
      return revolve(capsule(shape.radius, shape.height, shape.segments), shape.segments);
    case BodyShape::Kind::sphere:
      break;
  }
  return revolve(capsule(shape.radius, 2 * shape.radius, shape.segments), shape.segments);
}

}  // namespace drape
