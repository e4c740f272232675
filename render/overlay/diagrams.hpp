#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "drape/render/image.hpp"
#include "drape/render/overlay/pen.hpp"

namespace drape {

/// A mark on an axis.
struct Tick {
  double value = 0;
  std::string label;
};

/// Returns the smallest 1, 2 or 5 times a power of ten that reaches a positive number.
double round_up(double number);

/// Returns marks at multiples of 1, 2 or 5 times a power of ten between two values, both included: `about` of them or a
/// few more.
std::vector<Tick> ticks(double from, double to, int about);

/// Returns the columns of a mark's label, from the first to the one after the last [pixels].
using LabelColumns = std::function<std::pair<int, int>(const Tick& mark)>;

/// Keeps the mark of value 0, or else the first, and every second, fifth, tenth … from it: as many as keep their labels
/// `gap` [pixels] apart.
/// @param marks in the order of their columns
std::vector<Tick> thinned(const std::vector<Tick>& marks, const LabelColumns& columns, int gap);

/// Returns the largest font size up to `size` at which a line fits into `room`, or else the least font size [pixels].
/// @param width width of the line at a font size
int fitting_size(const std::function<int(int)>& width, int size, int room);

/// Colours of the bands below pictures: black on white, as in a figure.
inline const Rgb band_paper{1, 1, 1}, band_ink{0.12, 0.12, 0.13};

/// Returns the height of a colour bar with its labels [pixels].
/// @param size font size [pixels]
int color_bar_height(int size);

/// Returns true if a colour bar's title fits above it, at least in the smallest letters.
bool has_room_for_title(Pen& pen, int width, int size, const std::string& title);

/// Draws the colours of viridis() from left to right, with a title above and labels below. The first and the last mark
/// are kept where there is no room for all.
/// @param marks labels; their values are positions in the bar, from 0 to 1
Image color_bar(Pen& pen, int width, int size, const std::string& title, const std::vector<Tick>& marks);

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
  [[nodiscard]] std::vector<Tick> levels(int rows) const;  // labelled marks of the vertical axis
  void draw_axes(Pen& pen, Image& band, const PictureBox& area) const;
  void draw_legend(Pen& pen, Image& band, int left) const;

  int width_, size_;
  std::string unit_;
  std::vector<double> times_;
  std::vector<Curve> curves_;
  double lowest_ = 0, highest_ = 0;  // range of the vertical axis
};

}  // namespace drape
