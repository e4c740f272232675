#pragma once

#include <string>
#include <vector>

#include "overlay/axis_ticks.hpp"
#include "overlay/pen.hpp"
#include "render/image.hpp"

namespace drape {

/// A curve of a diagram.
struct Curve {
  std::string name;
  Rgb color;
  std::vector<double> values;  ///< at the diagram's times
};

/// A diagram below a film: its axes span the whole film, its curves end at the current time.
class CurveBand {
 public:
  /// Returns its height [pixels].
  /// @param size font size [pixels]
  static int height(int size) { return 9 * size; }

  /// @param unit   unit of the values, as in "J"
  /// @param times  times of the curves' values, ascending; at least one [s]
  CurveBand(int width, int size, std::string unit, std::vector<double> times, std::vector<Curve> curves);

  /// Draws the diagram at a time of the film [s].
  [[nodiscard]] Image draw(Pen& pen, double time) const;

 private:
  void draw_axes(Pen& pen, Image& band, const PictureBox& area) const;
  void draw_legend(Pen& pen, Image& band, int left) const;

  int width_, size_;
  std::string unit_;
  std::vector<double> times_;
  std::vector<Curve> curves_;
  double lowest_ = 0, highest_ = 0;  // range of the vertical axis
};

}  // namespace drape
