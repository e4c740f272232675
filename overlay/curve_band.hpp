#pragma once

#include <string>
#include <vector>

#include "overlay/axis_ticks.hpp"
#include "overlay/pen.hpp"
#include "render/image.hpp"

namespace drape {

/// A line of a diagram.
struct Curve {
  std::string name;
  Rgb color;
  std::vector<double> values;  ///< at the diagram's times
};

/// A diagram that goes along under a film: its axes are those of the whole, its curves end where the film is.
class CurveBand {
 public:
  /// How high it is [pixels].
  /// @param size of the font [pixels]
  static int height(int size) { return 9 * size; }

  /// @param unit   of the values, as in "J"
  /// @param times  of the curves' values, ascending; at least one [s]
  CurveBand(int width, int size, std::string unit, std::vector<double> times, std::vector<Curve> curves);

  /// The diagram when the film is at a time [s].
  [[nodiscard]] Image draw(Pen& pen, double time) const;

 private:
  void draw_axes(Pen& pen, Image& band, const PictureBox& area) const;
  void draw_legend(Pen& pen, Image& band, int left) const;

  int width_, size_;
  std::string unit_;
  std::vector<double> times_;
  std::vector<Curve> curves_;
  double lowest_ = 0, highest_ = 0;  // of the axis
};

}  // namespace drape
