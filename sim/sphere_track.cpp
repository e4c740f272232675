#include "sim/sphere_track.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace drape {
namespace {

class Straight final : public SphereTrack {
 public:
  Straight(const SphereShape& start, const Eigen::Vector3d& velocity) : start_(start), velocity_(velocity) {}
  [[nodiscard]] SphereShape at(double time) const override { return {start_.center + time * velocity_, start_.radius}; }

 private:
  SphereShape start_;
  Eigen::Vector3d velocity_;
};

class Circling final : public SphereTrack {
 public:
  Circling(const SphereShape& start, const Orbit& orbit)
      : start_(start), axis_(orbit.axis.normalized()), period_(orbit.period) {
    const Eigen::Vector3d arm = start.center - orbit.center;
    middle_ = orbit.center + axis_.dot(arm) * axis_;
    arm_ = start.center - middle_;
    across_ = axis_.cross(arm_);
  }
  [[nodiscard]] SphereShape at(double time) const override {
    // Reduce to a fraction of a turn first, so that a whole number of periods returns exactly to the start.
    const double turns = std::remainder(time / period_, 1.0);
    if (turns == 0) return start_;
    const double angle = 2 * std::numbers::pi * turns;
    return {middle_ + std::cos(angle) * arm_ + std::sin(angle) * across_, start_.radius};
  }

 private:
  SphereShape start_;
  Eigen::Vector3d axis_, middle_, arm_, across_;
  double period_;
};

class Keyframed final : public SphereTrack {
 public:
  Keyframed(double radius, Keyframes centers) : radius_(radius), centers_(std::move(centers)) {}
  [[nodiscard]] SphereShape at(double time) const override { return {centers_.at(time), radius_}; }

 private:
  double radius_;
  Keyframes centers_;
};

class Resized final : public SphereTrack {
 public:
  Resized(std::shared_ptr<const SphereTrack> track, double radius) : track_(std::move(track)), radius_(radius) {}
  [[nodiscard]] SphereShape at(double time) const override { return {track_->at(time).center, radius_}; }

 private:
  std::shared_ptr<const SphereTrack> track_;
  double radius_;
};

}  // namespace

std::shared_ptr<const SphereTrack> straight_track(const SphereShape& start, const Eigen::Vector3d& velocity) {
  return std::make_shared<Straight>(start, velocity);
}

std::shared_ptr<const SphereTrack> circling_track(const SphereShape& start, const Orbit& orbit) {
  if (orbit.axis.isZero(0) || orbit.period == 0) throw std::invalid_argument("an orbit needs an axis and a period");
  return std::make_shared<Circling>(start, orbit);
}

std::shared_ptr<const SphereTrack> keyframed_track(double radius, Keyframes centers) {
  return std::make_shared<Keyframed>(radius, std::move(centers));
}

std::shared_ptr<const SphereTrack> with_radius(std::shared_ptr<const SphereTrack> track, double radius) {
  return std::make_shared<Resized>(std::move(track), radius);
}

}  // namespace drape
