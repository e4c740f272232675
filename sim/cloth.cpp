#include "sim/cloth.hpp"

#include <algorithm>
#include <stdexcept>

namespace drape {

Cloth make_cloth(const Mesh& start, const Mesh& rest, double mass, double stiffness, std::vector<int> pins) {
  if (start.positions.rows() != rest.positions.rows() || start.triangles != rest.triangles) {
    throw std::invalid_argument("the starting mesh and the rest mesh must have the same vertices and triangles");
  }
  Cloth cloth;
  cloth.positions = start.positions;
  cloth.velocities = Vertices::Zero(start.positions.rows(), 3);
  cloth.rest = rest.positions;
  cloth.triangles = start.triangles;
  cloth.masses.setConstant(start.positions.rows(), mass / static_cast<double>(start.positions.rows()));

  for (const auto& [i, j] : unique_edges(rest.triangles)) {
    const double length = (rest.positions.row(i) - rest.positions.row(j)).norm();
    cloth.springs.push_back({.i = i, .j = j, .rest_length = length, .stiffness = stiffness});
  }

  std::sort(pins.begin(), pins.end());
  pins.erase(std::unique(pins.begin(), pins.end()), pins.end());
  if (!pins.empty() && (pins.front() < 0 || pins.back() >= cloth.vertex_count())) {
    throw std::invalid_argument("a pin is not a vertex of the cloth");
  }
  cloth.pins = std::move(pins);
  return cloth;
}

double size_of(const Cloth& cloth) {
  const Vertices& x = cloth.positions;
  double size = (x.colwise().maxCoeff() - x.colwise().minCoeff()).stableNorm();
  for (const Spring& spring : cloth.springs) size = std::max(size, spring.rest_length);
  return size;
}

}  // namespace drape
