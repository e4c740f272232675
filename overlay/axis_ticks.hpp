#pragma once

#include <string>
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

}  // namespace drape
