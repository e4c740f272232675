#include "html/chart_axis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace drape::html {
namespace {

constexpr int wanted_ticks = 6;        // decades with ticks
constexpr std::size_t most_ticks = 7;  // on a linear axis
constexpr std::size_t fewest_ticks = 3;
constexpr double room_around = 0.05;                // margin, as a fraction of the axis
constexpr double room_for_zero = 0.1, near = 0.02;  // fractions of the axis
constexpr double rounding = 1e-9;                   // tolerance for a value beyond its tick

/// Returns a power of ten: "10⁻⁷".
std::string power(int exponent) {
  constexpr std::array<const char*, 10> digits{"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = exponent < 0 ? "10⁻" : "10";
  for (const char digit : std::to_string(std::abs(exponent))) text += digits[static_cast<std::size_t>(digit - '0')];
  return text;
}

/// Returns a digit times a power of ten: "0.02" or "500" if plain, otherwise "10⁻⁷" or "2·10⁵".
std::string factor_and_power(int factor, int exponent, bool plain) {
  if (plain) return short_number(factor * std::pow(10, exponent));
  return (factor == 1 ? "" : fmt::format("{}·", factor)) + power(exponent);
}

/// Labels for the multiples of a step in one format: "0", "0.5", "1", or "5·10⁻⁶".
class TickLabels {
 public:
  TickLabels(double step, double low, double high) {
    const double largest = std::max(std::abs(low), std::abs(high));
    const int leading = static_cast<int>(std::floor(std::log10(largest) + rounding));
    const int last = static_cast<int>(std::floor(std::log10(step) + rounding));
    if (leading >= most_digits || last < -most_digits) exponent_ = leading;
    decimals_ = std::max(0, exponent_ - last);
  }

  [[nodiscard]] std::string operator()(double value) const {
    if (value == 0) return "0";
    const std::string number = fmt::format("{:.{}f}", std::abs(value) / std::pow(10, exponent_), decimals_);
    return (value < 0 ? "−" : "") + number + (exponent_ == 0 ? "" : "·" + power(exponent_));
  }

 private:
  static constexpr int most_digits = 5;  // before or after the point
  int exponent_ = 0, decimals_ = 0;
};

std::vector<double> multiples(double step, double low, double high) {
  std::vector<double> numbers;
  const double first = std::ceil(low / step - rounding);
  for (int i = 0; first + i <= high / step + rounding; ++i) numbers.push_back((first + i) * step + 0.0);  // + 0: no −0
  return numbers;
}

/// Returns the smallest round step with at most most_ticks ticks on a linear axis.
double round_step(double low, double high) {
  for (double decade = std::pow(10, std::floor(std::log10((high - low) / most_ticks)));; decade *= 10) {
    for (const int factor : {1, 2, 5}) {
      if (multiples(factor * decade, low, high).size() <= most_ticks) return factor * decade;
    }
  }
}

/// Extends the ends of an axis to ticks that are almost there.
void widen(double& low, double& high, double step) {
  const double reach = near * (high - low);
  const double below = std::floor(low / step) * step, above = std::ceil(high / step) * step;
  if (low - below < reach) low = below;
  if (above - high < reach) high = above;
}

}  // namespace

bool is_plain(int lowest, int highest) { return lowest >= -3 && highest <= 3; }

std::string power_of_ten(int exponent, bool plain) { return factor_and_power(1, exponent, plain); }

std::string short_number(double value) { return fmt::format("{:.4g}", value); }

AxisMap::AxisMap(Scale scale, const std::vector<double>& values) : scale_(scale), room_(room_around) {
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
  if (zero) ticks_.push_back({place(0), "0"});
  make_logarithmic(std::log10(low), std::log10(high));
}

AxisMap::AxisMap(const std::vector<std::string>& names)
    : scale_(Scale::linear), low_(-0.5), high_(static_cast<double>(names.size()) - 0.5) {
  constexpr std::size_t room = 80;  // letters, approximately
  std::size_t letters = 0;
  for (const std::string& name : names) letters += name.size() + 1;
  const std::size_t stride = letters / room + 1;
  for (std::size_t i = 0; i < names.size(); i += stride) ticks_.push_back({place(static_cast<double>(i)), names[i]});
}

void AxisMap::make_linear(double low, double high) {
  if (low == high) low -= 0.5 * std::max(1.0, std::abs(low)), high += 0.5 * std::max(1.0, std::abs(high));
  const double step = round_step(low, high);
  widen(low, high, step);
  low_ = low;
  high_ = high;
  const TickLabels label(step, low, high);
  for (const double value : multiples(step, low, high)) ticks_.push_back({place(value), label(value)});
}

void AxisMap::make_logarithmic(double low, double high) {
  if (low == high) low -= 0.5, high += 0.5;
  widen(low, high, 1);
  low_ = low;
  high_ = high;
  const int first = static_cast<int>(std::floor(low + rounding)), last = static_cast<int>(std::floor(high + rounding));
  const int stride = (last - first + wanted_ticks) / (wanted_ticks + 1);
  const bool plain = is_plain(first, last);
  const bool between = high - low < 2.5;  // narrow range: ticks within a decade
  for (int exponent = first; exponent <= last; exponent += std::max(1, stride)) {
    for (const int factor : {1, 2, 5}) {
      const double place_of_it = exponent + std::log10(factor);
      if ((factor > 1 && !between) || place_of_it < low - rounding || place_of_it > high + rounding) continue;
      ticks_.push_back({place(factor * std::pow(10, exponent)), factor_and_power(factor, exponent, plain)});
    }
  }
  if (ticks_.size() >= fewest_ticks + (floor_ > 0 ? 1 : 0)) return;
  ticks_.erase(ticks_.begin() + (floor_ > 0 ? 1 : 0), ticks_.end());
  const double from = std::pow(10, low), to = std::pow(10, high);
  const double step = round_step(from, to);
  const TickLabels label(step, from, to);
  for (const double value : multiples(step, from, to)) ticks_.push_back({place(value), label(value)});
}

double AxisMap::place(double value) const {
  const double between = 1 - 2 * room_;
  if (scale_ == Scale::linear) return room_ + between * (value - low_) / (high_ - low_);
  if (!(value > 0)) return room_;
  return room_ + between * (floor_ + (1 - floor_) * std::clamp((std::log10(value) - low_) / (high_ - low_), 0.0, 1.0));
}

}  // namespace drape::html
