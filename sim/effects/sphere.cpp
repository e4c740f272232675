#include "sim/effects/sphere.hpp"

#include <cmath>
#include <optional>

#include "sim/effects/contact.hpp"
#include "sim/sphere_track.hpp"

namespace drape {
namespace {

/// The ball of `reach` around `center`. At the centre itself no direction leads outwards.
struct Ball {
  Eigen::Vector3d center;
  double reach;

  bool find(const Eigen::Vector3d& point, Touch& touch) const {
    touch.away = point - center;
    const Eigen::Vector3d& d = touch.away;
    const double squared = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
    if (squared >= reach * reach || squared == 0) return false;
    touch.distance = std::sqrt(squared);
    touch.depth = reach - touch.distance;
    return true;
  }
  [[nodiscard]] double clearance(const Eigen::Vector3d& point) const { return (point - center).norm() - reach; }
  [[nodiscard]] Eigen::Vector3d normal(const Eigen::Vector3d& point) const { return (point - center).normalized(); }
};

/// The homework's penalty, a = k·max(s·r − ‖x−c‖, 0)·(x−c)/‖x−c‖, comes from the ball of s·r around c.
struct SphereSurface {
  std::shared_ptr<const SphereTrack> track;
  double scale;

  [[nodiscard]] Ball at(double time) const {
    const SphereShape shape = track->at(time);
    return {shape.center, scale * shape.radius};
  }
  [[nodiscard]] Eigen::Vector3d displacement(double from, double to) const {
    return track->at(to).center - track->at(from).center;
  }
};

struct TrackedSphere final : ColliderMotion {
  std::shared_ptr<const SphereTrack> track;
  explicit TrackedSphere(std::shared_ptr<const SphereTrack> t) : track(std::move(t)) {}
  [[nodiscard]] Collider at(double time) const override { return track->at(time); }
};

class Sphere final : public Effect {
 public:
  void describe(Keys& keys) override {
    keys.add("center", &center_, "m", "Where its centre is at the start.").must_be_given_unless({"keyframes", "track"});
    keys.add("radius", &radius_, "m", "Its radius, as it is drawn.").must_be_given_unless({"track"}).above(0);
    keys.add("scale", &scale_, "", "Where it pushes: within scale·radius of the centre.").at_least(1);
    contact_.describe(keys, "; left out, the push gives back what it takes");
    keys.add("velocity", &velocity_, "m/s", "It moves straight on from `center`.");
    keys.add("orbit_period", &orbit_period_, "s",
             "It circles, starting from `center`, and takes as long for a turn; negative: the other way round.");
    keys.add("orbit_center", &orbit_.center, "m", "A point of the axis that it circles around.");
    keys.add("orbit_axis", &orbit_.axis, "",
             "The direction of that axis, seen from whose tip it goes counterclockwise.");
    keys.add("keyframes", KeyframeList{{"center"}, &keyframes_}, "s, m", "Where its centre is at which times.");
    keys.choice("interpolation", interpolation_, {"linear", "smooth"},
                "How it gets from one keyframe to the next: at a steady speed, or without jumps of its speed.");
    keys.add("track", &track_, "",
             "An ASCII USD file whose first moving Mesh or Sphere it follows, in place and size; at the file's start "
             "time code the clock shows 0 s.");
  }

  void check(const SimulationSettings& settings, const ProblemSink& problem) const override {
    const int motions =
        int{velocity_.has_value()} + int{orbit_period_.has_value()} + int{!keyframes_.empty()} + int{track_ != nullptr};
    if (motions > 1) {
      problem("", "give only one of 'velocity', 'orbit_period', 'keyframes' and 'track': each says where it is");
    }
    const bool placed = !keyframes_.empty() || track_ != nullptr;
    if (center_ && placed) {
      problem("center", std::string("'") + (track_ ? "track" : "keyframes") + "' already says where its centre is");
    }
    if (!radius_ && track_ && !(track_->at(0).radius > 0)) {
      problem("track", "what moves in this file has no size: give the 'radius' as well");
    }
    if (orbit_period_ && *orbit_period_ == 0) problem("orbit_period", "expected a time other than 0");
    if (orbit_.axis.isZero(0)) problem("orbit_axis", "expected a direction, found [0, 0, 0]");
    contact_.check(settings, problem);
  }

  void install(System& system) const override {
    const std::shared_ptr<const SphereTrack> track = make_track();
    system.colliders.push_back(std::make_unique<TrackedSphere>(track));
    install_contact(SphereSurface{track, scale_}, contact_, system);
  }

 private:
  [[nodiscard]] std::shared_ptr<const SphereTrack> make_track() const {
    if (track_) return radius_ ? with_radius(track_, *radius_) : track_;
    if (!keyframes_.empty()) return keyframed_track(radius_.value(), Keyframes(keyframes_, interpolation_));
    const SphereShape start{center_.value(), radius_.value()};
    if (!orbit_period_) return straight_track(start, velocity_.value_or(Eigen::Vector3d::Zero()));
    return circling_track(start, {orbit_.center, orbit_.axis, *orbit_period_});
  }

  std::optional<Eigen::Vector3d> center_;
  std::optional<double> radius_;
  double scale_ = 1.1;
  ContactValues contact_;
  std::optional<Eigen::Vector3d> velocity_;
  std::optional<double> orbit_period_;
  Orbit orbit_;
  std::vector<Keyframe> keyframes_;
  Interpolation interpolation_ = Interpolation::linear;
  std::shared_ptr<const SphereTrack> track_;
};

}  // namespace

std::unique_ptr<Effect> make_sphere() { return std::make_unique<Sphere>(); }

}  // namespace drape
