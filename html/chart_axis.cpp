#include "html/chart_axis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace drape::html {
namespace {

constexpr int wanted_ticks = 6;
constexpr double room_for_zero = 0.1;

/// 10 to a power: "0.01", "100", and beyond that "10⁻⁷".
std::string power_of_ten(int exponent) {
  if (std::abs(exponent) <= 3) return short_number(std::pow(10, exponent));
  constexpr std::array<const char*, 10> digits{"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = exponent < 0 ? "10⁻" : "10";
  for (const char digit : std::to_string(std::abs(exponent))) text += digits[static_cast<std::size_t>(digit - '0')];
  return text;
}

}  // namespace

std::string short_number(double value) { return fmt::format("{:.4g}", value); }

AxisMap::AxisMap(Scale scale, const std::vector<double>& values) : scale_(scale) {
  double low = INFINITY, high = -INFINITY;
  bool zero = false;
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    if (scale == Scale::logarithmic && value <= 0) {
      zero = true;
      continue;
    }
    low = std::min(low, value);
    high = std::max(high, value);
  }
  if (low > high) low = scale == Scale::linear ? 0 : 0.1, high = 1;
  if (scale == Scale::linear) {
    make_linear(low, high);
    return;
  }
  floor_ = zero ? room_for_zero : 0;
  if (zero) ticks_.push_back({0, "0"});
  make_logarithmic(std::log10(low), std::log10(high));
}

void AxisMap::make_linear(double low, double high) {
  if (low == high) low -= 0.5 * std::max(1.0, std::abs(low)), high += 0.5 * std::max(1.0, std::abs(high));
  const double rough = (high - low) / wanted_ticks;
  const double decade = std::pow(10, std::floor(std::log10(rough)));
  const double ratio = rough / decade;
  const double step = decade * (ratio <= 1 ? 1 : ratio <= 2 ? 2 : ratio <= 5 ? 5 : 10);
  const double first = std::floor(low / step + 1e-9), last = std::ceil(high / step - 1e-9);
  low_ = first * step;
  high_ = last * step;
  for (double k = first; k <= last; ++k) ticks_.push_back({place(k * step), short_number(k * step)});
}

void AxisMap::make_logarithmic(double low, double high) {
  low_ = std::floor(low + 1e-9);
  high_ = std::max(std::ceil(high - 1e-9), low_ + 1);
  const int decades = static_cast<int>(high_ - low_);
  const int stride = (decades + wanted_ticks) / (wanted_ticks + 1);
  for (int k = 0; k <= decades; k += stride) {
    const double value = std::pow(10, low_ + k);
    ticks_.push_back({place(value), power_of_ten(static_cast<int>(low_) + k)});
    if (decades > 2 || k == decades) continue;
    for (const int factor : {2, 5}) ticks_.push_back({place(factor * value), short_number(factor * value)});
  }
}

double AxisMap::place(double value) const {
  if (scale_ == Scale::linear) return (value - low_) / (high_ - low_);
  if (!(value > 0)) return 0;
  return floor_ + (1 - floor_) * std::clamp((std::log10(value) - low_) / (high_ - low_), 0.0, 1.0);
}

}  // namespace drape::html
