#include "output/poster_frame.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <map>

namespace drape {

PosterFrame::PosterFrame(const std::vector<Triangle>& triangles) {
  std::map<Edge, int> waiting;  // edges of one triangle so far, with its third vertex
  for (const Triangle& t : triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const int a = t[i], b = t[(i + 1) % 3], opposite = t[(i + 2) % 3];
      const Edge edge{std::min(a, b), std::max(a, b)};
      const auto [other, is_new] = waiting.emplace(edge, opposite);
      if (!is_new) hinges_.push_back({edge, {other->second, opposite}});
    }
  }
}

double PosterFrame::bend(const Vertices& x) const {
  double sum = 0;
  for (const Hinge& hinge : hinges_) {
    const Eigen::Vector3d from = x.row(hinge.edge[0]), edge = x.row(hinge.edge[1]).transpose() - from;
    const Eigen::Vector3d n = edge.cross(x.row(hinge.opposite[0]).transpose() - from),
                          m = (x.row(hinge.opposite[1]).transpose() - from).cross(edge);
    sum += edge.norm() * std::atan2(n.cross(m).norm(), n.dot(m));
  }
  return sum;
}

bool PosterFrame::see(const Vertices& positions) {
  constexpr double noise = 1e-9;  // rounding of coordinates bends even a flat cloth
  const double now = bend(positions);
  const int frame = seen_++;
  if (frame > 0 && now <= most_ + noise) return false;
  most_ = now;
  index_ = frame;
  return true;
}

}  // namespace drape
