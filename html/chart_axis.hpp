#pragma once

#include <string>
#include <vector>

namespace drape::html {

enum class Scale { linear, logarithmic };

/// Map from values to positions on an axis, with margins and ticks at round numbers. On a logarithmic axis, values of
/// zero or less share a position below the smallest positive value.
class AxisMap {
 public:
  struct Tick {
    double place = 0;  ///< 0 at the start to 1 at the end of the axis
    std::string label;
  };

  /// @param values values to include; non-finite ones are ignored
  AxisMap(Scale scale, const std::vector<double>& values);

  /// Makes an axis of names instead of numbers, at 0, 1, 2…
  explicit AxisMap(const std::vector<std::string>& names);

  /// Returns the position of a value: 0 at the start to 1 at the end.
  [[nodiscard]] double place(double value) const;
  [[nodiscard]] const std::vector<Tick>& ticks() const { return ticks_; }

 private:
  void make_linear(double low, double high);
  void make_logarithmic(double low, double high);

  Scale scale_;
  double low_ = 0, high_ = 1;  // range of the values, or of their decimal logarithms
  double floor_ = 0;           // fraction between the margins that is reserved for zero
  double room_ = 0;            // margin at both ends, as a fraction of the axis
  std::vector<Tick> ticks_;
};

/// Returns true if an axis writes powers of ten with these exponents as "0.01" and "100". All of its ticks have the
/// same format.
bool is_plain(int lowest, int highest);

/// Returns 10 to a power: "0.01" or "10⁻²".
std::string power_of_ten(int exponent, bool plain);

/// Formats a number: "0.25", "1e-06".
std::string short_number(double value);

}  // namespace drape::html
