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

LowerPattern spring_pattern(const std::vector<Spring>& springs, const FreeVertices& free) {
  std::vector<std::pair<int, int>> entries;  // column, row
  entries.reserve(springs.size() + static_cast<std::size_t>(free.count()));
  for (int f = 0; f < free.count(); ++f) entries.emplace_back(f, f);
  for (const Spring& spring : springs) {
    const auto [low, high] = std::minmax({free.number(spring.i), free.number(spring.j)});
    if (low >= 0) entries.emplace_back(low, high);
  }
  std::sort(entries.begin(), entries.end());
  entries.erase(std::unique(entries.begin(), entries.end()), entries.end());

  LowerPattern pattern;
  pattern.starts.assign(static_cast<std::size_t>(free.count()) + 1, 0);
  for (const auto& [column, row] : entries) {
    pattern.rows.push_back(row);
    pattern.starts[static_cast<std::size_t>(column) + 1] = static_cast<int>(pattern.rows.size());
  }
  return pattern;
}

}  // namespace drape
