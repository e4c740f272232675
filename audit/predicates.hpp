#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

namespace drape::audit {

/// An exact number: a sum of non-overlapping doubles (Shewchuk 1997, Adaptive Precision Floating-Point Arithmetic).
///
/// Sums, differences, products and halves are exact unless a part underflows or overflows. See `exact_range`.
class Expansion {
 public:
  Expansion() = default;  ///< zero
  explicit Expansion(double value);

  /// Returns a − b without rounding.
  static Expansion difference(double a, double b);

  [[nodiscard]] int sign() const;         ///< −1, 0 or 1
  [[nodiscard]] double estimate() const;  ///< nearest double, up to a few units in the last place
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

/// Range of coordinates with exact predicates: multiples of `grid` below `largest` in magnitude.
namespace exact_range {
constexpr double grid = 0x1p-200;    ///< [m]; a product of three coordinates halved 240 times is still a normal double
constexpr double largest = 0x1p100;  ///< [m]
}  // namespace exact_range

/// Rounds a coordinate to the nearest multiple of `exact_range::grid`; coordinates of 2⁻¹⁴⁸ m and more do not change.
/// @throws std::invalid_argument unless the coordinate is finite and below `exact_range::largest`
double on_exact_grid(double coordinate);

/// Returns the exact sign of the volume spanned by b−a, c−a and d−a. It is 1 if d is on the side from which a, b, c
/// turn counterclockwise, −1 on the other side, 0 in their plane.
///
/// A floating-point filter with Shewchuk's error bound decides most cases, exact expansions the others.
/// Coordinates as in `exact_range`.
int orientation(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c, const Eigen::Vector3d& d);

/// Returns the squared distance from a point to a triangle with its boundary [m²]. Rounded.
double square_distance(const Eigen::Vector3d& p, const std::array<Eigen::Vector3d, 3>& triangle);

}  // namespace drape::audit
