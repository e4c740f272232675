#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace drape {

/// Variables of a field's formulas, named like the members.
struct FieldPoint {
  double x = 0, y = 0, z = 0;     ///< position [m]
  double t = 0;                   ///< time [s]
  double vx = 0, vy = 0, vz = 0;  ///< velocity of the vertex there [m/s]
};

/// Three formulas in x, y, z, t, vx, vy and vz: "-9.8*sin(t) - 0.1*vx". The syntax is muParser's: + - * / ^,
/// comparisons, c ? a : b, sin, cos, exp, sqrt, abs, min, max and others, plus `pi`.
///
/// Sums, products and roots give the same bits everywhere; sin, exp, ^ and similar functions are those of the C
/// library. Results depend only on the arguments. One object may be used by one thread at a time.
class FormulaField {
 public:
  /// @throws std::invalid_argument with problem() of the first invalid formula
  explicit FormulaField(const std::array<std::string, 3>& formulas);
  ~FormulaField();
  FormulaField(FormulaField&&) noexcept;
  FormulaField& operator=(FormulaField&&) noexcept;

  /// Returns the values at a point, in the formulas' units.
  [[nodiscard]] std::array<double, 3> at(const FieldPoint& point) const;

  /// Returns true if any formula uses one of these names.
  [[nodiscard]] bool uses(std::span<const std::string_view> names) const;
  [[nodiscard]] bool uses_position() const;  ///< x, y or z
  [[nodiscard]] bool uses_time() const;      ///< t
  [[nodiscard]] bool uses_velocity() const;  ///< vx, vy or vz

  /// Returns the error of a formula, as the end of a sentence that has named it; nothing if it is valid.
  [[nodiscard]] static std::optional<std::string> problem(const std::string& formula);

 private:
  class Parsers;
  std::unique_ptr<Parsers> parsers_;
};

}  // namespace drape
