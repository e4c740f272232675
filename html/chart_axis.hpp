#pragma once

#include <string>
#include <vector>

namespace drape::html {

enum class Scale { linear, logarithmic };

/// Where values lie on an axis, with room before the first and after the last, and its ticks at round numbers. A
/// logarithmic axis has, where values of zero or less occur, a place for them below the smallest other.
class AxisMap {
 public:
  struct Tick {
    double place = 0;  ///< 0 at the axis' beginning to 1 at its end
    std::string label;
  };

  /// @param values that the axis must hold; those that are not finite do not count
  AxisMap(Scale scale, const std::vector<double>& values);

  /// An axis that has names instead of numbers, at 0, 1, 2…
  explicit AxisMap(const std::vector<std::string>& names);

  /// 0 at the beginning to 1 at the end.
  [[nodiscard]] double place(double value) const;
  [[nodiscard]] const std::vector<Tick>& ticks() const { return ticks_; }

 private:
  void make_linear(double low, double high);
  void make_logarithmic(double low, double high);

  Scale scale_;
  double low_ = 0, high_ = 1;  // of the values, or of their decimal logarithms
  double floor_ = 0;           // the part of what is between the rooms that is kept for zero
  double room_ = 0;            // the part of the axis on either side where no value is
  std::vector<Tick> ticks_;
};

/// Whether powers of ten of these exponents are written out on an axis, "0.01" and "100". All its ticks are of one
/// kind.
bool is_plain(int lowest, int highest);

/// 10 to a power: "0.01" or "10⁻²".
std::string power_of_ten(int exponent, bool plain);

/// A number as people write it: "0.25", "1e-06".
std::string short_number(double value);

}  // namespace drape::html
