#include "motion/vertex_order.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace drape {

std::optional<VertexOrder> match_vertices(const Vertices& x, const Vertices& other, double tolerance) {
  if (x.rows() != other.rows()) return std::nullopt;
  // Sort along a direction that separates vertices in usual meshes.
  const Eigen::Vector3d along = Eigen::Vector3d(0.5772, 0.6421, 0.5047).normalized();
  const Eigen::VectorXd places = other * along;
  VertexOrder sorted(static_cast<std::size_t>(other.rows()));
  std::iota(sorted.begin(), sorted.end(), 0);
  std::ranges::sort(sorted, {}, [&](int k) { return places[k]; });
  VertexOrder order(sorted.size(), -1);
  std::vector<bool> taken(sorted.size());
  for (Eigen::Index i = 0; i < x.rows(); ++i) {
    const double place = x.row(i).dot(along);
    int found = -1;
    for (auto at = std::ranges::lower_bound(sorted, place - tolerance, {}, [&](int k) { return places[k]; });
         at != sorted.end() && places[*at] <= place + tolerance; ++at) {
      if ((other.row(*at) - x.row(i)).norm() > tolerance) continue;
      if (found >= 0) return std::nullopt;
      found = *at;
    }
    if (found < 0 || taken[static_cast<std::size_t>(found)]) return std::nullopt;
    taken[static_cast<std::size_t>(found)] = true;
    order[static_cast<std::size_t>(i)] = found;
  }
  return order;
}

Vertices in_order(const Vertices& x, const VertexOrder& order) {
  Vertices y(x.rows(), 3);
  for (Eigen::Index i = 0; i < x.rows(); ++i) y.row(i) = x.row(order[static_cast<std::size_t>(i)]);
  return y;
}

Cloth in_order(Cloth cloth, const VertexOrder& order) {
  cloth.positions = in_order(cloth.positions, order);
  cloth.velocities = in_order(cloth.velocities, order);
  cloth.rest = in_order(cloth.rest, order);
  const Eigen::VectorXd masses = cloth.masses;
  std::vector<int> number(order.size());  // new number by old number
  for (std::size_t i = 0; i < order.size(); ++i) {
    cloth.masses[static_cast<Eigen::Index>(i)] = masses[order[i]];
    number[static_cast<std::size_t>(order[i])] = static_cast<int>(i);
  }
  const auto renumber = [&number](int& vertex) { vertex = number[static_cast<std::size_t>(vertex)]; };
  for (Triangle& triangle : cloth.triangles) std::ranges::for_each(triangle, renumber);
  for (Spring& spring : cloth.springs) {
    renumber(spring.i);
    renumber(spring.j);
    if (spring.i > spring.j) std::swap(spring.i, spring.j);
  }
  std::ranges::for_each(cloth.pins, renumber);
  std::ranges::sort(cloth.pins);
  return cloth;
}

}  // namespace drape
