#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "core/rgb.hpp"
#include "overlay/axis_ticks.hpp"

namespace drape {

/// Maps numbers from 0 to a limit to the colours of viridis(). The default limit is the smallest 1, 2 or 5 times a
/// power of ten that 95 % of the vertices stay below in nine of ten frames. So neither the few vertices of a sharp fold
/// nor a short impact press all others into one colour.
class ColorScale {
 public:
  explicit ColorScale(std::optional<double> limit) : limit_(limit) {}

  /// Returns true if the whole motion must be surveyed before the first frame is coloured.
  [[nodiscard]] bool needs_motion() const { return !limit_; }
  /// Surveys the numbers of the next frame.
  void survey(Eigen::VectorXd values);

  /// Returns the value of the last colour.
  [[nodiscard]] double limit() const;
  [[nodiscard]] std::vector<Rgb> colors(const Eigen::VectorXd& values) const;
  /// Returns the marks of a colour bar, at positions from 0 to 1.
  /// @param factor factor of the labels' numbers: 100 for percent
  [[nodiscard]] std::vector<Tick> marks(double factor) const;

 private:
  std::optional<double> limit_;
  std::vector<double> seen_;  // 95 % quantile of each frame
};

}  // namespace drape
