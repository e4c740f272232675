#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "core/rgb.hpp"
#include "overlay/axis_ticks.hpp"

namespace drape {

/// The colours of viridis() for numbers from 0 up to a limit: one that is given, or else the smallest of 1, 2 and 5
/// times a power of ten that 95 % of a frame's vertices stay below in nine frames of ten. So neither a few vertices in
/// the sharpest fold nor a short blow leave all others in one colour.
class ColorScale {
 public:
  explicit ColorScale(std::optional<double> limit) : limit_(limit) {}

  /// Whether the numbers of the whole motion must be seen before the first are coloured.
  [[nodiscard]] bool needs_motion() const { return !limit_; }
  /// The numbers of the next frame.
  void survey(Eigen::VectorXd values);

  /// What the last colour stands for.
  [[nodiscard]] double limit() const;
  [[nodiscard]] std::vector<Rgb> colors(const Eigen::VectorXd& values) const;
  /// The marks of a bar, at places from 0 to 1.
  /// @param factor of the numbers that they show: 100 for percent
  [[nodiscard]] std::vector<Tick> marks(double factor) const;

 private:
  std::optional<double> limit_;
  std::vector<double> seen_;  // what 95 % of the vertices of each frame stay below
};

}  // namespace drape
