#include "sim/effects/body.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include "core/keys.hpp"
#include "sim/collision/body_contact.hpp"
#include "sim/effects/contact.hpp"
#include "sim/effects/motion_keys.hpp"

namespace drape {
namespace {

/// Where vertices were found to be beside a body. It saves time and changes nothing about what is found.
struct Known {
  const PlacedMesh* mesh = nullptr;  // of which it is known, while it has not moved
  int moves = 0;
  Point point = Point::Zero();  // in the body's coordinates
  double clear = 0;             // how far from there nothing pushes, at least [m]
  bool found = false;
  Foot foot;
};

/// A body at one moment, with the layer in which it pushes.
struct BodyLayer {
  BodyAt body;
  double thickness;
  std::vector<Known>& known;  // of each vertex

  bool find(Eigen::Index vertex, const Eigen::Vector3d& point, SurfaceContact& contact) const {
    const PlacedMesh& mesh = *body.mesh;
    Known& k = known[static_cast<std::size_t>(vertex)];
    const Point place = body.pose.in(point);
    const bool same = k.mesh == &mesh && k.moves == mesh.moves();
    if (same && k.clear > 0 && (place - k.point).squaredNorm() < k.clear * k.clear) return false;
    if (!same || place != k.point) look(mesh, place, k);
    if (!k.found || k.foot.distance >= thickness) return false;
    contact.outward = body.pose.turn * k.foot.normal;
    contact.length = 1;
    contact.gap = k.foot.distance - thickness;
    contact.triangle = k.foot.triangle;
    contact.weights = k.foot.weights;
    return true;
  }
  [[nodiscard]] double gap(const Eigen::Vector3d& point) const { return nearest(point).distance - thickness; }
  [[nodiscard]] Eigen::Vector3d normal(const Eigen::Vector3d& point) const {
    return body.pose.turn * nearest(point).normal;
  }

 private:
  void look(const PlacedMesh& mesh, const Point& place, Known& k) const {
    const double reach = 2 * thickness;
    const std::optional<Foot> foot = mesh.find(place, reach, k.foot.triangle);
    // A little less than all of it, so that rounding does not matter.
    const double distance = foot ? foot->distance : std::max(reach, mesh.tree().distance(place));
    k = {&mesh, mesh.moves(), place, (1 - 1e-9) * (distance - thickness), foot.has_value(), foot.value_or(k.foot)};
  }
  [[nodiscard]] Foot nearest(const Eigen::Vector3d& point) const {
    return body.mesh->find(body.pose.in(point), std::numeric_limits<double>::infinity()).value_or(Foot{});
  }
};

struct BodySurface {
  std::shared_ptr<const MovingBody> body;
  double thickness;
  std::shared_ptr<std::vector<Known>> known;

  [[nodiscard]] BodyLayer at(double time) const { return {body->at(time), thickness, *known}; }
  [[nodiscard]] Eigen::Vector3d displacement(double from, double to) const { return body->displacement(from, to); }
  [[nodiscard]] Eigen::Vector3d displacement(const SurfaceContact& contact, double from, double to) const {
    return body->displacement(contact.triangle, contact.weights, from, to);
  }
};

struct DrawnBody final : ColliderMotion {
  std::shared_ptr<const MovingBody> body;
  std::shared_ptr<const std::vector<Triangle>> triangles;
  double thickness;
  DrawnBody(std::shared_ptr<const MovingBody> b, double t)
      : body(std::move(b)),
        triangles(std::make_shared<std::vector<Triangle>>(body->topology().triangles)),
        thickness(t) {}
  [[nodiscard]] Collider at(double time) const override {
    return MeshShape{triangles, body->positions(time), thickness};
  }
};

Eigen::Matrix3d rotation(const Eigen::Vector3d& degrees) {
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  for (int axis = 0; axis < 3; ++axis) {
    if (degrees[axis] == 0) continue;
    turn = Eigen::AngleAxisd(degrees[axis] * std::numbers::pi / 180, Eigen::Vector3d::Unit(axis)) * turn;
  }
  return turn;
}

}  // namespace

Mesh make_box(const Eigen::Vector3d& size) {
  Mesh mesh;
  mesh.positions.resize(8, 3);
  for (int corner = 0; corner < 8; ++corner) {
    for (int axis = 0; axis < 3; ++axis) mesh.positions(corner, axis) = (corner >> axis & 1 ? 0.5 : -0.5) * size[axis];
  }
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

void Body::describe(Keys& keys) {
  keys.add("box", &box, "m", "Sides of a box around `center`.").must_be_given_unless({"file"}).above(0);
  keys.add("file", OwnForm{"file", &mesh}, "",
           "Mesh file instead, as for a cloth, or an OBJ sequence, \"arm/{frame:04}.obj\", of 24 per second; it may "
           "move. Its "
           "coordinates are relative to `center`.");
  keys.add("prim", &prim, "", "Which mesh of a USD file, where there are several: \"/World/arm\".");
  keys.add("center", &center, "m",
           "Position of the box's centre, or the file's origin, at the start. Default: [0, 0, 0].");
  keys.add("rotate", &rotate, "degrees", "Rotates it about the fixed x axis, then y, then z, around `center`.");
  keys.add("thickness", &thickness, "m", "Reach of the push: within this distance of the drawn surface.").above(0);
  describe_contact(keys, stiffness, response, friction, restitution, "");
  describe_motion(keys, "center", velocity, orbit_period, orbit_center, orbit_axis, keyframes, interpolation);
}

void Body::check(const SimulationSettings& settings, const ProblemSink& problem) const {
  if (box && mesh) problem("box", "give only one of 'box' and 'file': each is the body's shape");
  if (!prim.empty() && !mesh) problem("prim", "names a mesh in a 'file', and there is none");
  if (mesh && mesh->mesh.triangles.empty()) problem("file", "the mesh has no triangles for the cloth to collide with");
  if (int{velocity.has_value()} + int{orbit_period.has_value()} + int{!keyframes.empty()} > 1) {
    problem("", "give only one of 'velocity', 'orbit_period' and 'keyframes': each defines the motion");
  }
  if (center && !keyframes.empty()) problem("center", "'keyframes' already says where its centre is");
  check_orbit(orbit_period, orbit_axis, problem);
  law().check(settings, problem);
}

void Body::install(System& system) const {
  const std::shared_ptr<const MovingBody> moving = body();
  system.colliders.push_back(std::make_unique<DrawnBody>(moving, thickness));
  const auto known = std::make_shared<std::vector<Known>>(static_cast<std::size_t>(system.cloth.vertex_count()));
  install_contact(BodySurface{moving, thickness, known}, law(), system);
  const BodyLaw limits{thickness, friction, std::sqrt(stiffness)};
  system.filters.push_back(std::make_unique<BodyContact>(moving, limits, system.cloth));
}

ContactLaw Body::law() const { return {stiffness, response, friction, restitution}; }

std::shared_ptr<const MovingBody> Body::body() const {
  const auto shape = box ? std::make_shared<const MeshMotion>(MeshMotion{.mesh = make_box(*box)}) : mesh;
  const SphereShape start{center.value_or(Eigen::Vector3d::Zero())};
  if (!keyframes.empty()) {
    const auto path = keyframed_track(1, Keyframes(keyframes, interpolation));
    return std::make_shared<MovingBody>(shape, RigidMotion(path, rotation(rotate), std::nullopt));
  }
  if (!orbit_period) {
    const auto path = straight_track(start, velocity.value_or(Eigen::Vector3d::Zero()));
    return std::make_shared<MovingBody>(shape, RigidMotion(path, rotation(rotate), std::nullopt));
  }
  const Orbit orbit{orbit_center, orbit_axis, *orbit_period};
  return std::make_shared<MovingBody>(shape, RigidMotion(circling_track(start, orbit), rotation(rotate), orbit));
}

}  // namespace drape
