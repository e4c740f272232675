#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace drape {

/// What formulas of a field are made of, by the names of the members.
struct FieldPoint {
  double x = 0, y = 0, z = 0;     ///< where [m]
  double t = 0;                   ///< when [s]
  double vx = 0, vy = 0, vz = 0;  ///< how fast what is there moves [m/s]
};

/// Three numbers by three formulas in x, y, z, t, vx, vy and vz: "-9.8*sin(t) - 0.1*vx". They are muParser's: + - * /
/// ^, comparisons, c ? a : b, sin, cos, exp, sqrt, abs, min, max and others; `pi` is there too.
///
/// Sums, products and roots have the same bits everywhere; sin, exp, ^ and their like have those of the C library.
/// What it computes depends on the arguments alone, but it may be used by one thread at a time.
class FormulaField {
 public:
  /// @throws std::invalid_argument what problem() says of the first formula with one
  explicit FormulaField(const std::array<std::string, 3>& formulas);
  ~FormulaField();
  FormulaField(FormulaField&&) noexcept;
  FormulaField& operator=(FormulaField&&) noexcept;

  /// The values at a point, in the formulas' units.
  [[nodiscard]] std::array<double, 3> at(const FieldPoint& point) const;

  /// Whether any of the formulas has one of these names in it.
  [[nodiscard]] bool uses(std::span<const std::string_view> names) const;
  [[nodiscard]] bool of_place() const;     ///< x, y or z
  [[nodiscard]] bool of_time() const;      ///< t
  [[nodiscard]] bool of_velocity() const;  ///< vx, vy or vz

  /// What is wrong with a formula, as the end of a sentence that has named it; nothing if it can be evaluated.
  [[nodiscard]] static std::optional<std::string> problem(const std::string& formula);

 private:
  class Parsers;
  std::unique_ptr<Parsers> parsers_;
};

}  // namespace drape
