#pragma once

#include <vector>

namespace drape::audit {

/// An exact number: a sum of doubles that do not overlap (Shewchuk 1997, Adaptive Precision Floating-Point Arithmetic).
///
/// Sums, differences, products and halves are exact while no part underflows or overflows. See `exact_range`.
class Expansion {
 public:
  Expansion() = default;  ///< zero
  explicit Expansion(double value);

  /// a − b, without rounding.
  static Expansion difference(double a, double b);

  [[nodiscard]] int sign() const;         ///< −1, 0 or 1
  [[nodiscard]] double estimate() const;  ///< the nearest double, up to a few units in its last place
  [[nodiscard]] Expansion half() const;
  [[nodiscard]] Expansion operator-() const;

  Expansion operator+(const Expansion& other) const;
  Expansion operator-(const Expansion& other) const { return *this + -other; }
  Expansion operator*(const Expansion& other) const;

 private:
  void add(double value);
  void compress();

  std::vector<double> parts_;  // by increasing magnitude, none zero
};

/// The coordinates for which all predicates are exact: multiples of `grid` below `largest` in magnitude.
namespace exact_range {
constexpr double grid = 0x1p-200;    ///< [m]; a product of three coordinates halved 240 times is still a normal double
constexpr double largest = 0x1p100;  ///< [m]
}  // namespace exact_range

/// The nearest coordinate for which predicates are exact: coordinates of 2⁻¹⁴⁸ m and more stay as they are.
/// @throws std::invalid_argument unless the coordinate is finite and below `exact_range::largest`
double on_exact_grid(double coordinate);

}  // namespace drape::audit
