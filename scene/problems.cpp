#include "scene/problems.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "core/text.hpp"

namespace drape {

std::string Problems::text(const Place& place) const {
  if (place.override_number > 0) return fmt::format("--set {}", overrides_[place.override_number - 1]);
  if (place.line == 0) return shown(file_);
  return fmt::format("{}:{}:{}", shown(file_), place.line, place.column);
}

std::string Problems::text() const {
  // Longer lists are not useful to a reader.
  constexpr std::size_t most_told = 100;
  std::vector<const Problem*> sorted;
  for (const Problem& problem : found_) sorted.push_back(&problem);
  std::stable_sort(sorted.begin(), sorted.end(), [](auto* a, auto* b) { return a->place < b->place; });
  std::string text;
  for (const Problem* problem : std::span(sorted).first(std::min(most_told, sorted.size()))) {
    const auto& [place, message] = *problem;
    if (!text.empty()) text += '\n';
    text += fmt::format("{}: {}", this->text(place), message);
  }
  if (sorted.size() > most_told) text += fmt::format("\nand {} more", sorted.size() - most_told);
  return escape_controls(text);
}

}  // namespace drape
