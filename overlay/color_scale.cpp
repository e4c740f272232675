#include "overlay/color_scale.hpp"

#include <algorithm>
#include <cmath>

#include "overlay/color_map.hpp"

namespace drape {
namespace {

constexpr double shown_part = 0.95;   // fraction of a frame's vertices within the limit
constexpr double shown_frames = 0.9;  // fraction of the frames with so many vertices

}  // namespace

void ColorScale::survey(Eigen::VectorXd values) {
  if (values.size() == 0) return;
  const auto place = static_cast<Eigen::Index>(shown_part * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + place, values.end());
  seen_.push_back(values[place]);
}

double ColorScale::limit() const {
  constexpr double least = 1e-9;  // floor for a cloth with zeros everywhere: all of it gets the first colour
  if (limit_) return *limit_;
  if (seen_.empty()) return round_up(least);
  std::vector<double> frames = seen_;
  const auto place = static_cast<std::ptrdiff_t>(std::ceil(shown_frames * static_cast<double>(frames.size() - 1)));
  std::nth_element(frames.begin(), frames.begin() + place, frames.end());
  return round_up(std::max(frames[static_cast<std::size_t>(place)], least));
}

std::vector<Rgb> ColorScale::colors(const Eigen::VectorXd& values) const {
  std::vector<Rgb> colors;
  const double top = limit();
  for (const double value : values) colors.push_back(viridis(value / top));
  return colors;
}

std::vector<Tick> ColorScale::marks(double factor) const {
  const double top = limit() * factor;
  std::vector<Tick> marks = ticks(0, top, 5);
  for (Tick& mark : marks) mark.value /= top;
  if (marks.back().value > 1 - 1e-6) marks.back().label = "≥ " + marks.back().label;
  return marks;
}

}  // namespace drape
