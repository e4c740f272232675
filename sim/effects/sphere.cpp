#include "sim/effects/sphere.hpp"

#include <cmath>

#include "core/keys.hpp"
#include "sim/contact/obstacles.hpp"
#include "sim/contact/surface_contacts.hpp"
#include "sim/effects/contact.hpp"
#include "sim/effects/motion_keys.hpp"

namespace drape {
namespace {

/// At the centre itself no direction leads outwards.
struct Ball {
  Eigen::Vector3d center;
  double radius;

  bool find(const Eigen::Vector3d& point, SurfaceContact& contact) const {
    contact.outward = point - center;
    const Eigen::Vector3d& d = contact.outward;
    const double squared = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
    if (squared >= radius * radius || squared == 0) return false;
    contact.length = std::sqrt(squared);
    contact.gap = contact.length - radius;
    return true;
  }
  [[nodiscard]] double gap(const Eigen::Vector3d& point) const { return (point - center).norm() - radius; }
  [[nodiscard]] Eigen::Vector3d normal(const Eigen::Vector3d& point) const { return (point - center).normalized(); }
};

/// How far beyond its centre a sphere pushes: scale·radius + thickness, of which one is 1 or 0.
struct Reach {
  double scale, thickness;

  [[nodiscard]] double of(double radius) const { return scale * radius + thickness; }
};

/// The homework's penalty, a = k·max(s·r − ‖x−c‖, 0)·(x−c)/‖x−c‖, comes from the ball of s·r around c.
struct SphereSurface {
  std::shared_ptr<const SphereTrack> track;
  Reach reach;

  [[nodiscard]] Ball at(double time) const {
    const SphereShape shape = track->at(time);
    return {shape.center, reach.of(shape.radius)};
  }
  [[nodiscard]] Eigen::Vector3d displacement(double from, double to) const {
    return track->at(to).center - track->at(from).center;
  }
};

struct TrackedSphere final : ColliderMotion {
  std::shared_ptr<const SphereTrack> track;
  Reach reach;
  bool resting;
  TrackedSphere(std::shared_ptr<const SphereTrack> t, const Reach& r, bool still)
      : track(std::move(t)), reach(r), resting(still) {}
  [[nodiscard]] bool rests() const override { return resting; }
  [[nodiscard]] Collider at(double time) const override {
    SphereShape shape = track->at(time);
    shape.reach = reach.of(shape.radius);
    return shape;
  }
};

}  // namespace

void Sphere::describe(Keys& keys) {
  keys.add("center", &center, "m", "Position of its centre at the start.").must_be_given_unless({"keyframes", "track"});
  keys.add("radius", &radius, "m", "Its radius, as drawn.").must_be_given_unless({"track"}).above(0);
  keys.add("scale", &scale, "", "Reach of the push: within scale·radius of the centre. Default: 1.1.").at_least(1);
  keys.add("thickness", &thickness, "m", "Or its reach beyond the radius, whatever that is, in place of `scale`.")
      .at_least(0);
  describe_contact(keys, stiffness, response, friction, restitution, "; if omitted, the push acts as a spring");
  describe_motion(keys, "center", velocity, orbit_period, orbit_center, orbit_axis, keyframes, interpolation);
  keys.add("track", OwnForm{"file", &track}, "",
           "ASCII USD file whose first moving Mesh or Sphere it follows, position and size. The file's start time code "
           "is 0 s.");
}

void Sphere::check(const SimulationSettings& settings, const ProblemSink& problem) const {
  const int motions =
      int{velocity.has_value()} + int{orbit_period.has_value()} + int{!keyframes.empty()} + int{track != nullptr};
  if (motions > 1) {
    problem("", "give only one of 'velocity', 'orbit_period', 'keyframes' and 'track': each defines the motion");
  }
  const bool placed = !keyframes.empty() || track != nullptr;
  if (center && placed) {
    problem("center", std::string("'") + (track ? "track" : "keyframes") + "' already says where its centre is");
  }
  if (scale && thickness) {
    problem("thickness", "give only one of 'scale' and 'thickness': each says how far the push reaches");
  }
  if (!radius && track && !(track->at(0).radius > 0)) {
    problem("track", "the moving object in this file has no size: also give the 'radius'");
  }
  check_orbit(orbit_period, orbit_axis, problem);
  law(has_impulses(settings)).check(settings, problem);
}

void Sphere::install(System& system) const {
  const std::shared_ptr<const SphereTrack> moving = motion();
  const Reach reach = thickness ? Reach{1, *thickness} : Reach{scale.value_or(usual_scale), 0};
  const bool rests = !velocity && !orbit_period && keyframes.empty() && track == nullptr;
  system.colliders.push_back(std::make_unique<TrackedSphere>(moving, reach, rests));
  const ContactLaw contact = law(system.impulses);
  if (contact.response == Response::solved) {
    const ContactTerms terms{reach.thickness, friction, restitution.value_or(0)};
    system.contacts.push_back(
        std::make_unique<SurfaceContacts<BallObstacle>>(BallObstacle{moving, reach.scale}, terms));
    return;
  }
  install_contact(SphereSurface{moving, reach}, contact, system);
}

ContactLaw Sphere::law(bool impulses) const {
  // The homework's penalty is a push and nothing else.
  const bool pushes = stiffness || (friction == 0 && !restitution && !thickness);
  return {stiffness, response_or_usual(response, impulses && !pushes), friction, restitution};
}

std::shared_ptr<const SphereTrack> Sphere::motion() const {
  if (track) return radius ? with_radius(track, *radius) : track;
  if (!keyframes.empty()) return keyframed_track(radius.value(), Keyframes(keyframes, interpolation));
  const SphereShape start{center.value(), radius.value()};
  if (!orbit_period) return straight_track(start, velocity.value_or(Eigen::Vector3d::Zero()));
  return circling_track(start, {orbit_center, orbit_axis, *orbit_period});
}

}  // namespace drape
