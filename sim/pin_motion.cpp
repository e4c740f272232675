#include "sim/pin_motion.hpp"

#include <algorithm>
#include <map>

namespace drape {

void PinMotion::place(double time, Vertices& x) const {
  const Eigen::RowVector3d moved = path.at(time).transpose();
  for (std::size_t k = 0; k < vertices.size(); ++k) x.row(vertices[k]) = base.row(static_cast<Eigen::Index>(k)) + moved;
}

void PinMotion::drive(double from, double to, Vertices& v) const {
  const Eigen::RowVector3d velocity = (path.at(to) - path.at(from)).transpose() / (to - from);
  for (const int vertex : vertices) v.row(vertex) = velocity;
}

void PinMotion::drive(double at, Vertices& v) const {
  const Eigen::RowVector3d velocity = path.velocity(at).transpose();
  for (const int vertex : vertices) v.row(vertex) = velocity;
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
