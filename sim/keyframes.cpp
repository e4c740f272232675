#include "sim/keyframes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

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

}  // namespace drape
