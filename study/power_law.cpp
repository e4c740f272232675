#include "study/power_law.hpp"

#include <cmath>

namespace drape {

double fitted_exponent(const std::vector<std::array<double, 2>>& points) {
  double count = 0, x_sum = 0, y_sum = 0, xx_sum = 0, xy_sum = 0;
  for (const auto& [px, py] : points) {
    if (!(px > 0) || !(py > 0)) continue;
    const double x = std::log(px), y = std::log(py);
    ++count;
    x_sum += x;
    y_sum += y;
    xx_sum += x * x;
    xy_sum += x * y;
  }
  return (count * xy_sum - x_sum * y_sum) / (count * xx_sum - x_sum * x_sum);
}

}  // namespace drape
