#include "render/overlay/color_scale.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

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
  const double spacing = marks[1].value - marks[0].value, rest = top - marks.back().value;
  if (rest > 1e-6 * top) {
    if (rest < spacing / 2) marks.pop_back();
    marks.push_back({top, fmt::format("{:g}", top)});
  }
  for (Tick& mark : marks) mark.value /= top;
  marks.back().label = "≥ " + marks.back().label;
  return marks;
}

namespace {

/// Every fifth of the 256 published colours, as bytes; linear interpolation is exact to one byte.
constexpr std::array<std::array<std::uint8_t, 3>, 52> anchors{{
    {68, 1, 84},    {70, 8, 92},    {71, 16, 99},   {72, 23, 105},  {72, 29, 111},  {72, 36, 117},  {71, 42, 122},
    {70, 48, 126},  {69, 55, 129},  {67, 61, 132},  {65, 66, 135},  {63, 72, 137},  {61, 78, 138},  {58, 83, 139},
    {56, 89, 140},  {53, 94, 141},  {51, 99, 141},  {49, 104, 142}, {46, 109, 142}, {44, 113, 142}, {42, 118, 142},
    {41, 123, 142}, {39, 128, 142}, {37, 132, 142}, {35, 137, 142}, {33, 142, 141}, {32, 146, 140}, {31, 151, 139},
    {30, 156, 137}, {31, 161, 136}, {33, 165, 133}, {36, 170, 131}, {40, 174, 128}, {46, 179, 124}, {53, 183, 121},
    {61, 188, 116}, {70, 192, 111}, {80, 196, 106}, {90, 200, 100}, {101, 203, 94}, {112, 207, 87}, {124, 210, 80},
    {137, 213, 72}, {149, 216, 64}, {162, 218, 55}, {176, 221, 47}, {189, 223, 38}, {202, 225, 31}, {216, 226, 25},
    {229, 228, 25}, {241, 229, 29}, {253, 231, 37},
}};

}  // namespace

Rgb viridis(double value) {
  const double at = std::clamp(value, 0.0, 1.0) * (anchors.size() - 1);
  const auto before = std::min(static_cast<std::size_t>(at), anchors.size() - 2);
  const double along = at - static_cast<double>(before);
  const auto channel = [&](std::size_t c) {
    return std::lerp(anchors[before][c], anchors[before + 1][c], along) / 255;
  };
  return {channel(0), channel(1), channel(2)};
}

VertexMeasure::VertexMeasure(ColorBy what, const Cloth& cloth)
    : what_(what), stretch_(cloth.rest, cloth.triangles), curvature_(cloth.vertex_count(), cloth.triangles) {}

Eigen::VectorXd VertexMeasure::operator()(const Frame& frame) const {
  if (what_ == ColorBy::stretch) return stretch_(frame.positions).array() - 1;
  if (what_ == ColorBy::speed) return frame.velocities.rowwise().norm();
  return curvature_(frame.positions);
}

std::string VertexMeasure::title() const {
  switch (what_) {
    case ColorBy::stretch:
      return "stretch [%]";
    case ColorBy::speed:
      return "speed [m/s]";
    case ColorBy::curvature:
      return "curvature [1/m]";
  }
  return {};
}

}  // namespace drape
