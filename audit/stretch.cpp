#include "audit/stretch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace drape::audit {

std::string describe(const StretchedEdge& stretched) {
  return fmt::format("cloth edge {} {} is stretched to {:.6g}", stretched.edge[0], stretched.edge[1],
                     stretched.stretch);
}

std::vector<StretchedEdge> find_stretched(const std::vector<Edge>& edges, const Vertices& rest, const Vertices& x,
                                          double limit) {
  if (rest.rows() != x.rows()) {
    throw std::invalid_argument(fmt::format("{} positions need as many at rest, found {}", x.rows(), rest.rows()));
  }
  std::vector<StretchedEdge> found;
  for (const Edge& edge : edges) {
    const auto length = [&](const Vertices& of) { return (of.row(edge[0]) - of.row(edge[1])).norm(); };
    const double now = length(x), at_rest = length(rest);
    if (now <= limit * at_rest) continue;
    const double stretch = now / at_rest;
    found.push_back({edge, stretch >= 0 ? stretch : std::numeric_limits<double>::infinity()});  // NaN is unsortable
  }
  std::ranges::sort(found, [](const StretchedEdge& a, const StretchedEdge& b) {
    return a.stretch != b.stretch ? a.stretch > b.stretch : a.edge < b.edge;
  });
  return found;
}

}  // namespace drape::audit
