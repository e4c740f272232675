#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace drape {

/// A mark on an axis.
struct Tick {
  double value = 0;
  std::string label;
};

/// Returns the smallest 1, 2 or 5 times a power of ten that reaches a positive number.
double round_up(double number);

/// Returns marks at multiples of 1, 2 or 5 times a power of ten between two values, both included: `about` of them or a
/// few more.
std::vector<Tick> ticks(double from, double to, int about);

/// Returns the columns of a mark's label, from the first to the one after the last [pixels].
using LabelColumns = std::function<std::pair<int, int>(const Tick& mark)>;

/// Keeps the first mark and every second, fifth, tenth … after it: as many as keep their labels `gap` [pixels] apart.
std::vector<Tick> thinned(const std::vector<Tick>& marks, const LabelColumns& columns, int gap);

}  // namespace drape
