#include "sim/linear/free_vertices.hpp"

#include <algorithm>
#include <utility>

namespace drape {

FreeVertices::FreeVertices(const Cloth& cloth) : numbers_(static_cast<std::size_t>(cloth.vertex_count()), 0) {
  for (const int pin : cloth.pins) numbers_[static_cast<std::size_t>(pin)] = -1;
  for (int vertex = 0; vertex < cloth.vertex_count(); ++vertex) {
    int& number = numbers_[static_cast<std::size_t>(vertex)];
    if (number < 0) continue;
    number = count();
    vertices_.push_back(vertex);
  }
}

Vertices FreeVertices::rest_places(const Cloth& cloth) const {
  const Vertices& shape = cloth.rest.rows() == cloth.vertex_count() ? cloth.rest : cloth.positions;
  Vertices places(count(), 3);
  for (int f = 0; f < count(); ++f) places.row(f) = shape.row(vertex(f));
  return places;
}

LowerPattern spring_pattern(const StiffnessBound& bound, const FreeVertices& free) {
  using Index = std::size_t;
  const auto n = static_cast<Index>(free.count());
  const auto each = [&](const auto& visit) {
    bound.for_each_pair([&](const Spring& spring) {
      const auto [low, high] = std::minmax({free.number(spring.i), free.number(spring.j)});
      if (low >= 0) visit(static_cast<Index>(low), high);
    });
  };
  std::vector<int> next(n + 1, 0);  // next free index of each column, after its diagonal
  each([&](Index low, int) { ++next[low + 1]; });
  for (Index c = 0; c < n; ++c) next[c + 1] += next[c] + 1;
  std::vector<int> rows(static_cast<Index>(next[n]));
  const std::vector<int> begins = next;
  for (Index c = 0; c < n; ++c) rows[static_cast<Index>(next[c]++)] = static_cast<int>(c);
  each([&](Index low, int high) { rows[static_cast<Index>(next[low]++)] = high; });

  LowerPattern pattern{.starts = {0}, .rows = {}};
  pattern.starts.reserve(n + 1);
  pattern.rows.reserve(rows.size());
  for (Index c = 0; c < n; ++c) {
    const auto begin = rows.begin() + begins[c], end = rows.begin() + begins[c + 1];
    std::sort(begin, end);
    pattern.rows.insert(pattern.rows.end(), begin, std::unique(begin, end));
    pattern.starts.push_back(static_cast<int>(pattern.rows.size()));
  }
  return pattern;
}

}  // namespace drape
