#include "scene/problems.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.hpp"

namespace drape {

std::string Problems::text(const Place& place) const {
  return place.override_number == 0 ? fmt::format("{}:{}:{}", file_.string(), place.line, place.column)
                                    : fmt::format("--set {}", overrides_[place.override_number - 1]);
}

void Problems::throw_if_any() const {
  if (found_.empty()) return;
  std::vector<Problem> sorted = found_;
  std::stable_sort(sorted.begin(), sorted.end(), [](const Problem& a, const Problem& b) { return a.place < b.place; });
  std::string text;
  for (const auto& [place, message] : sorted) {
    if (!text.empty()) text += '\n';
    text += fmt::format("{}: {}", this->text(place), message);
  }
  throw UsageError(text);
}

}  // namespace drape
