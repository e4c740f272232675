#include "overlay/vertex_coloring.hpp"

namespace drape {

VertexMeasure::VertexMeasure(ColorBy what, const Cloth& cloth)
    : what_(what), stretch_(cloth.rest, cloth.triangles), curvature_(cloth.vertex_count(), cloth.triangles) {}

Eigen::VectorXd VertexMeasure::operator()(const Frame& frame) const {
  if (what_ == ColorBy::stretch) return stretch_(frame.positions).array() - 1;
  if (what_ == ColorBy::speed) return frame.velocities.rowwise().norm();
  return curvature_(frame.positions);
}

std::string VertexMeasure::title() const {
  switch (what_) {
    case ColorBy::stretch:
      return "stretch [%]";
    case ColorBy::speed:
      return "speed [m/s]";
    case ColorBy::curvature:
      return "curvature [1/m]";
  }
  return {};
}

}  // namespace drape
