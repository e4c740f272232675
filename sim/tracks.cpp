#include "drape/sim/tracks.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "drape/sim/body_shape.hpp"
#include "sim/mesh_anchors.hpp"

namespace drape {
namespace {

/// Returns the slope at a keyframe from the slopes on both sides, over `before` and `after` seconds.
double slope_between(double left, double right, double before, double after) {
  if (left * right <= 0) return 0;
  const double a = 2 * after + before, b = after + 2 * before;
  return (a + b) / (a / left + b / right);
}

std::vector<Eigen::Vector3d> find_slopes(const std::vector<Keyframe>& keys) {
  std::vector<Eigen::Vector3d> slopes(keys.size(), Eigen::Vector3d::Zero());
  for (std::size_t i = 1; i + 1 < keys.size(); ++i) {
    const double before = keys[i].time - keys[i - 1].time, after = keys[i + 1].time - keys[i].time;
    const Eigen::Vector3d left = (keys[i].value - keys[i - 1].value) / before;
    const Eigen::Vector3d right = (keys[i + 1].value - keys[i].value) / after;
    for (int axis = 0; axis < 3; ++axis) slopes[i][axis] = slope_between(left[axis], right[axis], before, after);
  }
  return slopes;
}

/// Returns true if two times are equal up to the rounding of step·h.
bool same(double a, double b) {
  return std::abs(a - b) <= 4 * std::numeric_limits<double>::epsilon() * std::max(std::abs(a), std::abs(b));
}

}  // namespace

std::vector<Keyframe> starting_at(std::vector<Keyframe> keyframes, const Eigen::Vector3d& value) {
  if (keyframes.empty() || keyframes.front().time > 0) keyframes.insert(keyframes.begin(), {0, value});
  return keyframes;
}

Keyframes::Keyframes(std::vector<Keyframe> keyframes, Interpolation interpolation) : keyframes_(std::move(keyframes)) {
  if (keyframes_.empty()) throw std::invalid_argument("a motion needs at least one keyframe");
  for (std::size_t i = 1; i < keyframes_.size(); ++i) {
    if (!(keyframes_[i - 1].time < keyframes_[i].time)) {
      throw std::invalid_argument("keyframes must be at increasing times");
    }
  }
  if (interpolation == Interpolation::smooth) slopes_ = find_slopes(keyframes_);
}

Eigen::Vector3d Keyframes::at(double time) const {
  const auto next = std::upper_bound(keyframes_.begin(), keyframes_.end(), time,
                                     [](double t, const Keyframe& key) { return t < key.time; });
  if (next != keyframes_.end() && same(time, next->time)) return next->value;
  if (next == keyframes_.begin()) return next->value;
  const Keyframe& from = *(next - 1);
  if (next == keyframes_.end() || same(time, from.time)) return from.value;

  const double span = next->time - from.time, s = (time - from.time) / span;
  if (slopes_.empty()) return from.value + s * (next->value - from.value);
  const auto i = static_cast<std::size_t>(next - keyframes_.begin());
  const double rise = s * s * (3 - 2 * s);
  return from.value + rise * (next->value - from.value) +
         span * (s * (1 - s) * (1 - s) * slopes_[i - 1] - s * s * (1 - s) * slopes_[i]);
}

Eigen::Vector3d Keyframes::velocity(double time) const {
  const auto next = std::find_if(keyframes_.begin(), keyframes_.end(),
                                 [&](const Keyframe& key) { return key.time > time || same(time, key.time); });
  if (next == keyframes_.begin() || next == keyframes_.end()) return Eigen::Vector3d::Zero();
  const Keyframe& from = *(next - 1);
  const double span = next->time - from.time, s = std::min(1.0, (time - from.time) / span);
  Eigen::Vector3d mean = (next->value - from.value) / span;
  if (slopes_.empty()) return mean;
  const auto i = static_cast<std::size_t>(next - keyframes_.begin());
  return 6 * s * (1 - s) * mean + (1 - s) * (1 - 3 * s) * slopes_[i - 1] - s * (2 - 3 * s) * slopes_[i];
}

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

namespace {

constexpr double radians = std::numbers::pi / 180;

}  // namespace

void PinMotion::place(double time, Vertices& x) const {
  if (only_shifts()) {
    const Eigen::RowVector3d moved = path.at(time).transpose();
    for (std::size_t k = 0; k < vertices.size(); ++k) {
      x.row(vertices[k]) = base.row(static_cast<Eigen::Index>(k)) + moved;
    }
    return;
  }
  for (std::size_t k = 0; k < vertices.size(); ++k) x.row(vertices[k]) = position(k, time).transpose();
}

void PinMotion::drive(double from, double to, Vertices& v) const {
  if (only_shifts()) {
    const Eigen::RowVector3d all = (path.at(to) - path.at(from)).transpose() / (to - from);
    for (const int vertex : vertices) v.row(vertex) = all;
    return;
  }
  for (std::size_t k = 0; k < vertices.size(); ++k) {
    v.row(vertices[k]) = (position(k, to) - position(k, from)).transpose() / (to - from);
  }
}

void PinMotion::drive(double at, Vertices& v) const {
  if (only_shifts()) {
    const Eigen::RowVector3d all = path.velocity(at).transpose();
    for (const int vertex : vertices) v.row(vertex) = all;
    return;
  }
  for (std::size_t k = 0; k < vertices.size(); ++k) v.row(vertices[k]) = velocity(k, at).transpose();
}

Eigen::Vector3d PinMotion::position(std::size_t k, double time) const {
  if (anchors) return anchors->at(k, time).position;
  const auto about = turns_about_axes(turn->at(time));
  const Eigen::Vector3d arm = base.row(static_cast<Eigen::Index>(k)).transpose() - middle;
  return middle + about[2] * (about[1] * (about[0] * arm)) + path.at(time);
}

Eigen::Vector3d PinMotion::velocity(std::size_t k, double time) const {
  if (anchors) return anchors->at(k, time).velocity;
  const auto about = turns_about_axes(turn->at(time));
  // Turns about x, y and z in this order: each rotates the result and the rates of the previous ones.
  const Eigen::Vector3d rates = turn->velocity(time) * radians;
  Eigen::Vector3d arm = base.row(static_cast<Eigen::Index>(k)).transpose() - middle, rate = Eigen::Vector3d::Zero();
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Matrix3d& turned = about[static_cast<std::size_t>(axis)];
    arm = turned * arm;
    rate = turned * rate + rates[axis] * Eigen::Vector3d::Unit(axis).cross(arm);
  }
  return rate + path.velocity(time);
}

std::vector<PinPhase> pin_phases(const std::vector<int>& pins, const std::vector<PinRelease>& releases) {
  std::map<std::int64_t, std::vector<int>> released{{0, {}}};
  for (const PinRelease& release : releases) {
    std::vector<int>& vertices = released[std::max<std::int64_t>(release.step, 0)];
    vertices.insert(vertices.end(), release.vertices.begin(), release.vertices.end());
  }
  std::vector<PinPhase> phases;
  std::vector<int> left = pins;
  for (const auto& [step, vertices] : released) {
    std::erase_if(left, [&gone = vertices](int pin) { return std::ranges::find(gone, pin) != gone.end(); });
    phases.push_back({step, left});
  }
  return phases;
}

}  // namespace drape
