#include "overlay/axis_ticks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace drape {

namespace {

/// Returns the largest 1, 2 or 5 times a power of ten up to a positive number.
double round_down(double number) {
  const double power = std::pow(10.0, std::floor(std::log10(number) + 1e-9));
  for (const double factor : {5.0, 2.0}) {
    if (number >= factor * power * (1 - 1e-9)) return factor * power;
  }
  return power;
}

}  // namespace

double round_up(double number) {
  const double power = std::pow(10.0, std::floor(std::log10(number)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (number <= factor * power * (1 + 1e-9)) return factor * power;
  }
  return 10 * power;
}

std::vector<Tick> ticks(double from, double to, int about) {
  if (!(to > from)) return {{from, fmt::format("{:g}", from)}};
  const double step = round_down((to - from) / about);
  std::vector<Tick> marks;
  for (double k = std::ceil(from / step - 1e-9); k * step <= to + 1e-9 * step; ++k) {
    const double value = k == 0 ? 0 : k * step;  // avoids -0
    marks.push_back({value, fmt::format("{:g}", value)});
  }
  return marks;
}

std::vector<Tick> thinned(const std::vector<Tick>& marks, const LabelColumns& columns, int gap) {
  for (double every = 1; every < static_cast<double>(marks.size()); every = round_up(1.5 * every)) {
    std::vector<Tick> kept;
    for (std::size_t i = 0; i < marks.size(); i += static_cast<std::size_t>(every)) kept.push_back(marks[i]);
    const auto touch = [&](const Tick& a, const Tick& b) { return columns(b).first < columns(a).second + gap; };
    if (std::ranges::adjacent_find(kept, touch) == kept.end()) return kept;
  }
  return {marks.begin(), marks.begin() + std::min<std::ptrdiff_t>(1, std::ssize(marks))};
}

}  // namespace drape
