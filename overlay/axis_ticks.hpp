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

/// 1, 2 or 5 times a power of ten: the smallest that is not below a number above 0.
double round_up(double number);

/// Marks at multiples of such a number between two values, both included, as many as are asked for or a few
/// more.
std::vector<Tick> ticks(double from, double to, int about);

/// The columns that a mark's label takes, from the first to the one after the last [pixels].
using LabelColumns = std::function<std::pair<int, int>(const Tick& mark)>;

/// The first mark and every second, fifth, tenth … after it, the most whose labels stand so far apart [pixels].
std::vector<Tick> thinned(const std::vector<Tick>& marks, const LabelColumns& columns, int gap);

}  // namespace drape
