#include "run/vertex_coloring.hpp"

#include <algorithm>

#include "overlay/color_map.hpp"

namespace drape {
namespace {

constexpr double shown_part = 0.95;  // of a frame's vertices, within the limit

}  // namespace

VertexColoring::VertexColoring(ColorBy what, std::optional<double> limit, const Cloth& cloth)
    : what_(what),
      limit_(limit),
      stretch_(cloth.rest, cloth.triangles),
      curvature_(cloth.vertex_count(), cloth.triangles) {}

FrameContents VertexColoring::contents() const {
  return what_ == ColorBy::speed ? FrameContents::motion : FrameContents::places;
}

Eigen::VectorXd VertexColoring::values(const Frame& frame) const {
  if (what_ == ColorBy::stretch) return stretch_(frame.positions).array() - 1;
  return what_ == ColorBy::speed ? frame.velocities.rowwise().norm() : curvature_(frame.positions);
}

void VertexColoring::survey(const Frame& frame) {
  Eigen::VectorXd all = values(frame);
  if (all.size() == 0) return;
  const auto place = static_cast<Eigen::Index>(shown_part * static_cast<double>(all.size() - 1));
  std::nth_element(all.begin(), all.begin() + place, all.end());
  seen_ = std::max(seen_, all[place]);
}

double VertexColoring::limit() const {
  if (limit_) return *limit_;
  constexpr double least = 1e-9;  // of a cloth that does nothing of the kind: all of it has the first colour
  return round_up(std::max(seen_, least));
}

std::vector<Rgb> VertexColoring::colors(const Frame& frame) const {
  std::vector<Rgb> colors;
  const double top = limit();
  for (const double value : values(frame)) colors.push_back(viridis(value / top));
  return colors;
}

std::string VertexColoring::title() const {
  switch (what_) {
    case ColorBy::stretch:
      return "stretched by [%]";
    case ColorBy::speed:
      return "speed [m/s]";
    case ColorBy::curvature:
      return "curvature [1/m]";
  }
  return {};
}

std::vector<Tick> VertexColoring::marks() const {
  const double top = limit() * (what_ == ColorBy::stretch ? 100 : 1);
  std::vector<Tick> marks = ticks(0, top, 5);
  for (Tick& mark : marks) mark.value /= top;
  if (marks.back().value > 1 - 1e-6) marks.back().label = "≥ " + marks.back().label;
  return marks;
}

}  // namespace drape
