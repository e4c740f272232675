#include "drape/sim/effects/sphere.hpp"

#include <fmt/format.h>
#include <cmath>
#include <utility>

#include "drape/sim/settings.hpp"
#include "sim/contact/contact.hpp"
#include "sim/contact/mesh_contacts.hpp"
#include "sim/effects/effect_keys.hpp"
#include "sim/parallel/vectors.hpp"
#include "sim/system.hpp"

namespace drape {
namespace {

/// Reach of a sphere from its centre, scale·radius + thickness, with either scale = 1 or thickness = 0.
struct Reach {
  double scale, thickness;

  [[nodiscard]] double of(double radius) const { return scale * radius + thickness; }
};

/// The homework's penalty, a = k·max(s·r − ‖x−c‖, 0)·(x−c)/‖x−c‖. At the centre there is no outward direction.
struct PenaltyForce final : Force {
  std::shared_ptr<const SphereTrack> track;
  Reach reach;
  double stiffness;
  const Eigen::VectorXd& masses;
  const Threads& threads;

  PenaltyForce(std::shared_ptr<const SphereTrack> t, const Reach& r, double k, const System& system)
      : track(std::move(t)), reach(r), stiffness(k), masses(system.cloth.masses), threads(system.threads) {}

  [[nodiscard]] double stiffness_bound() const override { return stiffness; }
  [[nodiscard]] bool of_contact() const override { return true; }

  void add(const State& state, double time, Vertices& force) const override {
    const SphereShape shape = track->at(time);
    const double radius = reach.of(shape.radius);
    for_all(threads, state.x.rows(), [&](Eigen::Index i) {
      const Eigen::Vector3d d = state.x.row(i).transpose() - shape.center;
      const double squared = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
      if (squared >= radius * radius || squared == 0) return;
      const double length = std::sqrt(squared), gap = length - radius;
      const double pressure = -masses[i] * stiffness * gap / length;
      force.row(i) += pressure * d.transpose();
    });
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
  keys.add("scale", &scale, "", "The cloth keeps scale·radius from the centre. Default: 1.1.").at_least(1);
  keys.add("thickness", &thickness, "m", "Or this distance from the drawn surface, whatever the radius.").at_least(0);
  describe_obstacle(keys, friction, &restitution);
  keys.add("stiffness", &stiffness, "1/s²",
           "Stiffness of a push instead of contact, for a sphere without `friction`, `restitution` and `thickness`: "
           "outward acceleration per metre of depth within its reach, evaluated once per step. Default: 8000.")
      .at_least(0);
  describe_motion(keys, "center", velocity, orbit_period, orbit_center, orbit_axis, keyframes, interpolation);
  keys.add("track", &track, "",
           "ASCII USD file whose first moving Mesh or Sphere it follows, position and size. The file's start time code "
           "is 0 s.");
  describe_overlap(keys, allow_overlap);
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
  if (pushes()) return check_push(settings, problem);
  if (stiffness) {
    problem("stiffness",
            "is of a push, which has neither friction nor restitution nor thickness: omit it, or all of these");
  }
}

void Sphere::check_push(const SimulationSettings& settings, const ProblemSink& problem) const {
  if (allow_overlap) {
    problem("allow_overlap", "is of contact; a sphere without friction, restitution and thickness pushes: omit it");
  }
  // Under the explicit penalty a vertex is a harmonic oscillator of frequency √k. Methods that evaluate the force at
  // the start of a step are unstable beyond h·√k = 2, however they treat the springs. Substeps chosen for an accuracy
  // or by the automatic method are short enough.
  if (settings.accuracy || settings.integrator.method == Method::automatic) return;
  const double h = settings.step / settings.integrator.substep_count();
  const double k = stiffness.value_or(usual_stiffness), product = h * std::sqrt(k);
  if (product <= 2) return;
  problem("stiffness",
          fmt::format("a push is unstable where step·√stiffness > 2, and here it is {:.3g}: with step = "
                      "{:g} s the stiffness can be at most {:.4g}, or with this stiffness the step at most {:.3g} s",
                      product, h, 4 / (h * h), 2 / std::sqrt(k)));
}

void Sphere::install(System& system) const {
  const std::shared_ptr<const SphereTrack> moving = motion();
  const Reach reach = thickness ? Reach{1, *thickness} : Reach{scale.value_or(usual_scale), 0};
  const bool rests = !velocity && !orbit_period && keyframes.empty() && track == nullptr;
  system.colliders.push_back(std::make_unique<TrackedSphere>(moving, reach, rests));
  if (pushes()) {
    const double k = stiffness.value_or(usual_stiffness);
    system.forces.push_back(std::make_unique<PenaltyForce>(moving, reach, k, system));
    return;
  }
  const ContactTerms terms{reach.thickness, friction, restitution.value_or(0)};
  system.contacts.push_back(std::make_unique<SurfaceContacts<BallObstacle>>(BallObstacle{moving, reach.scale}, terms));
}

std::shared_ptr<const SphereTrack> Sphere::motion() const {
  if (track) return radius ? with_radius(track, *radius) : track;
  if (!keyframes.empty()) return keyframed_track(radius.value(), Keyframes(keyframes, interpolation));
  const SphereShape start{center.value(), radius.value()};
  if (!orbit_period) return straight_track(start, velocity.value_or(Eigen::Vector3d::Zero()));
  return circling_track(start, {orbit_center, orbit_axis, *orbit_period});
}

}  // namespace drape
