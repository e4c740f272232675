#include "drape/render/view.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "render/smooth_surface.hpp"

namespace drape {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

double radians(double degrees) { return degrees * std::numbers::pi / 180; }

/// Returns the unit vector from the target to the camera.
Eigen::Vector3d direction(const Camera& camera) {
  const double azimuth = radians(camera.azimuth.value_or(Camera::usual_azimuth));
  const double elevation = radians(camera.elevation.value_or(Camera::usual_elevation));
  return {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth), std::sin(elevation)};
}

/// Returns the camera's up; if the camera looks along it, its limit as the camera rises to that direction.
Eigen::Vector3d usable_up(const Camera& camera) {
  const Eigen::Vector3d back = direction(camera);
  if (unit_vector(camera.up).cross(back).norm() > 1e-6) return camera.up;
  const double azimuth = radians(camera.azimuth.value_or(Camera::usual_azimuth));
  const double sign = camera.up.dot(back) > 0 ? -1 : 1;
  return {sign * std::cos(azimuth), sign * std::sin(azimuth), 0};
}

}  // namespace

Eigen::Matrix3d View::axes() const {
  const Eigen::Vector3d back = unit_vector(position - target);
  Eigen::Vector3d right = unit_vector(up).cross(back);
  if (right.norm() < 1e-6) right = Eigen::Vector3d::UnitY().cross(back);
  if (right.norm() < 1e-6) right = Eigen::Vector3d::UnitZ().cross(back);
  right.normalize();
  Eigen::Matrix3d rows;
  rows << right.transpose(), back.cross(right).transpose(), back.transpose();
  return rows;
}

Eigen::Matrix4d View::view_matrix() const {
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
  const Eigen::Matrix3d rows = axes();
  matrix.topLeftCorner<3, 3>() = rows;
  matrix.topRightCorner<3, 1>() = -rows * position;
  return matrix;
}

Eigen::Matrix4d View::projection_matrix(double aspect, const DepthRange& depth) const {
  const double scale = 1 / std::tan(radians(field_of_view) / 2);
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Zero();
  matrix(0, 0) = scale / aspect;
  matrix(1, 1) = scale;
  matrix(2, 2) = -(depth.far + depth.near) / (depth.far - depth.near);
  matrix(2, 3) = -2 * depth.far * depth.near / (depth.far - depth.near);
  matrix(3, 2) = -1;
  return matrix;
}

DepthRange depth_range(const View& view, const Frame& frame, double thickness) {
  const Eigen::Vector3d forward = -view.axes().row(2).transpose();
  const double origin = forward.dot(view.position);
  double nearest = infinity, farthest = -infinity;
  const auto add = [&](double depth, double radius) {
    nearest = std::min(nearest, depth - radius);
    farthest = std::max(farthest, depth + radius);
  };
  for (Eigen::Index i = 0; i < frame.positions.rows(); ++i) add(frame.positions.row(i).dot(forward) - origin, 0);
  int grounds = 0;
  double farthest_drawn = -infinity;  // depth at which body.vert draws the bodies, behind their place
  for (const Collider& collider : frame.colliders) {
    const auto* body = std::get_if<MeshShape>(&collider);
    grounds += std::holds_alternative<GroundShape>(collider) ? 1 : 0;
    for_each_ball(collider, [&](const Eigen::Vector3d& center, double radius) {
      const double depth = center.dot(forward) - origin;
      add(depth, radius);
      if (body != nullptr) farthest_drawn = std::max(farthest_drawn, depth + body->thickness);
    });
  }
  if (!(farthest > 0)) return {};  // everything is behind the camera
  // The drawn surface of a cloth extends a little beyond its vertices.
  const double room = thickness + 0.02 * std::max(farthest - nearest, 1e-3 * farthest);
  farthest += room;
  if (farthest_drawn > farthest) farthest = farthest_drawn + room;
  // A ground is seen in front of everything else and behind it, where its depth need only be that of the range's ends.
  // Two grounds hide each other where they meet.
  if (grounds > 1) return {0.01 * farthest, 10 * farthest};
  // A near plane at zero would leave no depth precision at all, so what nearly touches the camera is cut.
  return {std::max(nearest - room, 1e-3 * farthest), farthest};
}

View distant_view(const Camera& camera) {
  return {direction(camera), Eigen::Vector3d::Zero(), usable_up(camera), camera.field_of_view};
}

bool needs_motion(const Camera& camera) { return !camera.position || !camera.target; }

View fixed_view(const Camera& camera, const Vertices& start) {
  if (needs_motion(camera)) throw std::invalid_argument("fixed_view() needs a camera with position and target");
  View view{*camera.position, *camera.target, camera.up, camera.field_of_view};
  constexpr double room = 1.25;  // a target this near to the cloth stays
  const Eigen::Vector3d forward = unit_vector(view.target - view.position);
  const Eigen::ArrayXd depths = (start.rowwise() - view.position.transpose()) * forward;
  if (camera.orbit != 0 || start.rows() == 0 || depths.maxCoeff() <= 0) return view;
  const double nearest = std::max(0.0, depths.minCoeff()), farthest = depths.maxCoeff();
  const double distance = (view.target - view.position).norm();
  if (distance < nearest / room || distance > farthest * room) {
    view.target = view.position + (nearest + farthest) / 2 * forward;
  }
  return view;
}

Framing::Framing(const Camera& camera, double aspect) : camera_(camera) {
  axes_ = distant_view(camera).axes();
  const double free = (1 - 2 * camera.margin) * std::tan(radians(camera.field_of_view) / 2);
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const Widths tangents = Widths::LinSpaced(1.0 / widths, 1) * (axis == 0 ? free * aspect : free);
    Fan& fan = fans_[axis];
    fan.cosines = (1 + tangents.square()).rsqrt();
    fan.sines = tangents * fan.cosines;
    fan.upper.setConstant(-infinity);
    fan.lower.setConstant(-infinity);
  }
  lowest_.setConstant(infinity);
  highest_.setConstant(-infinity);
}

void Framing::add(const Vertices& positions) {
  for (Eigen::Index i = 0; i < positions.rows(); ++i) add_ball(positions.row(i).transpose(), 0);
}

void Framing::add(const Collider& collider) {
  for_each_ball(collider, [this](const Eigen::Vector3d& center, double radius) { add_ball(center, radius); });
}

void Framing::add_ball(const Eigen::Vector3d& center, double radius) {
  const Eigen::Vector3d p = axes_ * center;
  for (int axis = 0; axis < 2; ++axis) {
    Fan& fan = fans_[static_cast<std::size_t>(axis)];
    const Widths across = fan.cosines * p[axis], along = fan.sines * p[2] + radius;
    fan.upper = fan.upper.max(along + across);
    fan.lower = fan.lower.max(along - across);
  }
  lowest_ = lowest_.cwiseMin(center - Eigen::Vector3d::Constant(radius));
  highest_ = highest_.cwiseMax(center + Eigen::Vector3d::Constant(radius));
}

void Framing::end_frame() {
  if (camera_.outside <= 0) return;
  frames_.push_back(fans_);
  middles_.emplace_back((lowest_ + highest_) / 2);
  lowest_.setConstant(infinity);
  highest_.setConstant(-infinity);
  for (Fan& fan : fans_) {
    fan.upper.setConstant(-infinity);
    fan.lower.setConstant(-infinity);
  }
}

Eigen::Vector3d Framing::middle() const {
  if (middles_.empty()) return (lowest_ + highest_) / 2;
  Eigen::Vector3d median;
  std::vector<double> values(middles_.size());
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    std::ranges::transform(middles_, values.begin(), [axis](const Eigen::Vector3d& middle) { return middle[axis]; });
    const auto place = static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), values.begin() + place, values.end());
    median[axis] = values[static_cast<std::size_t>(place)];
  }
  return median;
}

// Moves each plane inwards until the allowed fraction of frames is beyond it, each plane on its own.
std::array<Framing::Fan, 2> Framing::without_farthest() const {
  std::array<Fan, 2> fans = fans_;
  if (frames_.empty()) return fans;
  const auto kept = static_cast<std::ptrdiff_t>((1 - camera_.outside) * static_cast<double>(frames_.size() - 1));
  std::vector<double> values(frames_.size());
  for (std::size_t axis = 0; axis < fans.size(); ++axis) {
    for (const auto bound : {&Fan::upper, &Fan::lower}) {
      for (int k = 0; k < widths; ++k) {
        for (std::size_t i = 0; i < frames_.size(); ++i) values[i] = (frames_[i][axis].*bound)[k];
        std::nth_element(values.begin(), values.begin() + kept, values.end());
        double& here = (fans[axis].*bound)[k];
        here = std::max(here, values[static_cast<std::size_t>(kept)]);
      }
    }
  }
  return fans;
}

View Framing::view() const {
  if (empty()) throw std::logic_error("Framing::view() before anything was added");
  if (camera_.position)
    return {*camera_.position, camera_.target.value_or(middle()), camera_.up, camera_.field_of_view};

  // With e = (x, y, z) in the camera's axes, the right and left planes are cos·x + sin·z ≥ upper and
  // -cos·x + sin·z ≥ lower; the top and bottom planes are the same with y.
  const std::array<Fan, 2> fans = without_farthest();
  Eigen::Vector3d target = axes_ * camera_.target.value_or(middle());
  Eigen::Vector3d eye = target;
  constexpr int free = widths - 1;
  eye[2] += 1e-3;  // keeps the camera away from a motion that is a single point
  for (int axis = 0; axis < 2; ++axis) {
    const Fan& fan = fans[static_cast<std::size_t>(axis)];
    if (camera_.target) {
      const double across = fan.cosines[free] * eye[axis];
      eye[2] = std::max(eye[2], (std::max(fan.upper[free] - across, fan.lower[free] + across)) / fan.sines[free]);
    } else {
      eye[2] = std::max(eye[2], (fan.upper[free] + fan.lower[free]) / (2 * fan.sines[free]));
    }
  }
  if (!camera_.target) {
    for (int axis = 0; axis < 2; ++axis) {
      const Fan& fan = fans[static_cast<std::size_t>(axis)];
      int narrowest = 0;  // of the frustums that contain the motion
      while (narrowest < free && fan.upper[narrowest] + fan.lower[narrowest] > 2 * fan.sines[narrowest] * eye[2]) {
        ++narrowest;
      }
      eye[axis] = (fan.upper[narrowest] - fan.lower[narrowest]) / (2 * fan.cosines[narrowest]);
      target[axis] = eye[axis];
    }
  }
  return {axes_.transpose() * eye, axes_.transpose() * target, usable_up(camera_), camera_.field_of_view};
}

}  // namespace drape
