#include "sim/pin_motion.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <map>
#include <numbers>

#include "sim/mesh_anchors.hpp"
#include "sim/rigid_motion.hpp"

namespace drape {
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
