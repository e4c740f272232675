#include "drape/sim/effects/body.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <utility>
#include <vector>

#include "core/keys.hpp"
#include "sim/contact/mesh_contacts.hpp"
#include "sim/effects/effect_keys.hpp"
#include "sim/system.hpp"

namespace drape {
namespace {

struct DrawnBody final : ColliderMotion {
  std::shared_ptr<const MovingBody> body;
  std::shared_ptr<const std::vector<Triangle>> triangles;
  double thickness;
  bool resting;
  DrawnBody(std::shared_ptr<const MovingBody> b, double t, bool still)
      : body(std::move(b)),
        triangles(std::make_shared<std::vector<Triangle>>(body->topology().triangles)),
        thickness(t),
        resting(still) {}
  [[nodiscard]] bool rests() const override { return resting; }
  [[nodiscard]] Collider at(double time) const override {
    return MeshShape{triangles, body->positions(time), thickness};
  }
};

void describe_shapes(Keys& keys, std::optional<BodyShape>& shape) {
  const auto add = [&](BodyShape::Kind kind, const char* help) {
    const std::string& name = body_shape_names()[static_cast<std::size_t>(kind)];
    keys.add(name, BodyShapeKey{kind, &shape}, "m", help);
  };
  using Kind = BodyShape::Kind;
  add(Kind::cylinder, "A cylinder around `center`, its axis along z; `segments` sides, 64.");
  add(Kind::capsule, "The same with round ends, within `height`.");
  add(Kind::cone, "A cone, or with a radius `top` of its upper end a frustum.");
  add(Kind::plane, "A rectangle across z with two sides.");
  add(Kind::sphere, "A ball of triangles; `[effects.sphere]` is a smooth one.");
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
  std::vector<std::string> others = body_shape_names();
  others.insert(others.begin(), "file");
  keys.add("box", &box, "m", "Sides of a box around `center`.").must_be_given_unless(std::move(others)).above(0);
  describe_shapes(keys, shape);
  keys.add(
      "file", &mesh, "",
      "Mesh file instead, which may move: as for a cloth, or an OBJ sequence, `\"arm/{frame:04}.obj\"`; or `{ file, "
      "prim, up, fps }`. Its coordinates are relative to `center`.");
  keys.add("prim", &prim, "", "Mesh of a USD file that has several: \"/World/arm\".");
  keys.add("center", &center, "m",
           "Position of the box's centre, or the file's origin, at the start. Default: [0, 0, 0].");
  keys.add("rotate", &rotate, "degrees", "Rotates it about the fixed x axis, then y, then z, around `center`.");
  keys.add("thickness", &thickness, "m", "Distance that the cloth keeps from the drawn surface.").above(0);
  describe_obstacle(keys, friction, &restitution);
  describe_motion(keys, "center", velocity, orbit_period, orbit_center, orbit_axis, keyframes, interpolation);
  keys.add(
      "rotations", KeyframeList{{"rotate"}, &turns}, "s, degrees",
      "Angles over time about the fixed x axis, then y, then z, around its centre, on top of `rotate`. They are 0 at "
      "0 s unless given then, and interpolated one by one: 720 is two turns.");
  describe_overlap(keys, allow_overlap);
}

void Body::check(const SimulationSettings&, const ProblemSink& problem) const {
  if (box && mesh) problem("box", "give only one of 'box' and 'file': each is the body's shape");
  if (shape && (box || mesh)) {
    const std::string& name = body_shape_names()[static_cast<std::size_t>(shape->kind)];
    problem(name, std::string("give only one of '") + (box ? "box" : "file") + "' and '" + name +
                      "': each is the body's shape");
  }
  if (!prim.empty() && !mesh) problem("prim", "names a mesh in a 'file', and there is none");
  if (mesh && mesh->mesh.triangles.empty()) problem("file", "the mesh has no triangles for the cloth to collide with");
  if (int{velocity.has_value()} + int{orbit_period.has_value()} + int{!keyframes.empty()} > 1) {
    problem("", "give only one of 'velocity', 'orbit_period' and 'keyframes': each defines the motion");
  }
  if (center && !keyframes.empty()) problem("center", "'keyframes' already says where its centre is");
  if (orbit_period && !turns.empty()) problem("rotations", "omit them on an orbit: the body turns with it");
  check_orbit(orbit_period, orbit_axis, problem);
}

void Body::install(System& system) const {
  const std::shared_ptr<const MovingBody> moving = body();
  const bool rests = !velocity && !orbit_period && keyframes.empty() && turns.empty() && !moving->deforms();
  system.colliders.push_back(std::make_unique<DrawnBody>(moving, thickness, rests));
  const ContactTerms terms{thickness, friction, restitution, allow_overlap};
  system.contacts.push_back(std::make_unique<BodyContacts>(moving, terms, system.cloth, system.threads));
}

std::shared_ptr<const MovingBody> Body::body() const {
  std::shared_ptr<const MeshMotion> form = mesh;
  if (box) form = std::make_shared<const MeshMotion>(MeshMotion{.mesh = make_box(*box)});
  if (shape) form = std::make_shared<const MeshMotion>(MeshMotion{.mesh = make_body_shape(*shape)});
  std::optional<Orbit> orbit;
  if (orbit_period) orbit = Orbit{orbit_center, orbit_axis, *orbit_period};
  std::optional<Keyframes> angles;
  if (!turns.empty()) angles = Keyframes(starting_at(turns, Eigen::Vector3d::Zero()), interpolation);
  return std::make_shared<MovingBody>(form, RigidMotion(path(orbit), turn_about_axes(rotate), orbit, angles));
}

std::shared_ptr<const SphereTrack> Body::path(const std::optional<Orbit>& orbit) const {
  if (!keyframes.empty()) return keyframed_track(1, Keyframes(keyframes, interpolation));
  const SphereShape start{center.value_or(Eigen::Vector3d::Zero())};
  return orbit ? circling_track(start, *orbit) : straight_track(start, velocity.value_or(Eigen::Vector3d::Zero()));
}

}  // namespace drape
