#include "audit/surface.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace drape::audit {

Topology make_topology(std::vector<Triangle> triangles) {
  for (const auto& [a, b, c] : triangles) {
    if (std::min({a, b, c}) < 0 || a == b || b == c || c == a) {
      throw std::invalid_argument(fmt::format("a triangle needs three different vertices, found {} {} {}", a, b, c));
    }
  }
  std::vector<Edge> edges = unique_edges(triangles);
  return {std::move(triangles), std::move(edges)};
}

std::string describe(Owner owner, std::vector<int> vertices) {
  static constexpr std::array<const char*, 3> names{"vertex", "edge", "triangle"};
  return fmt::format("{} {} {}", owner == Owner::cloth ? "cloth" : "body", names.at(vertices.size() - 1),
                     fmt::join(vertices, " "));
}

}  // namespace drape::audit
