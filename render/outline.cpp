#include "render/outline.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <utility>

#include "render/smooth_surface.hpp"

namespace drape {

Projection::Projection(const Shot& shot, Eigen::Vector2i picture)
    : to_clip_(shot.view_projection.cast<double>()), half_(picture.cast<double>() / 2) {}

Eigen::Vector3d Projection::point(const Eigen::Vector3d& x) const {
  constexpr double steps = 256;  // of a pixel
  const Eigen::Vector4d clip = to_clip_ * x.homogeneous();
  if (!(clip[3] > 0)) return Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  Eigen::Vector3d place = (clip.head<3>() / clip[3]).array() + 1;
  for (int axis = 0; axis < 2; ++axis) place[axis] = std::nearbyint(place[axis] * half_[axis] * steps) / steps;
  place[2] /= 2;
  return place;
}

std::vector<Eigen::Vector3d> Projection::points(const Vertices& x) const {
  std::vector<Eigen::Vector3d> projected;
  projected.reserve(static_cast<std::size_t>(x.rows()));
  for (const auto row : x.rowwise()) projected.push_back(point(row.transpose()));
  return projected;
}

MeshOutline::MeshOutline(const std::vector<Triangle>& triangles, const std::vector<Triangle>& drawn) {
  struct Known {
    std::size_t number;
    Edge drawn;
  };
  std::map<Edge, Known> known;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (std::size_t c = 0; c < 3; ++c) {
      std::size_t p = (c + 1) % 3, q = (c + 2) % 3;
      if (triangles[t][p] == triangles[t][q]) continue;
      if (triangles[t][p] > triangles[t][q]) std::swap(p, q);
      const Edge ends{triangles[t][p], triangles[t][q]}, corners{drawn[t][p], drawn[t][q]};
      const auto [place, is_new] = known.try_emplace(ends, Known{edges_.size(), corners});
      if (is_new) {
        edges_.push_back({ends[0], ends[1], triangles[t][c], -1, Kind::border});
        continue;
      }
      MeshEdge& edge = edges_[place->second.number];
      edge.kind = edge.kind == Kind::border && corners == place->second.drawn ? Kind::smooth : Kind::always;
      edge.right = triangles[t][c];
    }
  }
}

void MeshOutline::append(std::span<const Eigen::Vector3d> points, bool border,
                         std::vector<OutlineSegment>& outline) const {
  const auto at = [&](int vertex) -> const Eigen::Vector3d& { return points[static_cast<std::size_t>(vertex)]; };
  for (const MeshEdge& edge : edges_) {
    const Eigen::Vector3d &from = at(edge.from), &to = at(edge.to);
    const auto side = [&](int vertex) {
      return (to.x() - from.x()) * (at(vertex).y() - from.y()) - (to.y() - from.y()) * (at(vertex).x() - from.x());
    };
    if (edge.kind == Kind::border && !border) continue;
    if (edge.kind == Kind::smooth && side(edge.left) * side(edge.right) < 0) continue;
    outline.push_back({from, to});
  }
}

namespace {

/// Depth by which an outline may lie behind both pixels beside it and still be seen: between their middles, a slanting
/// surface comes nearer.
constexpr double hidden_by = 2e-4;

/// A pixel's change: the share of its neighbour's colour.
struct Blend {
  std::size_t pixel;  // number in the box
  float share;
  std::array<std::uint16_t, 4> neighbor;
};

/// Returns the part of a pixel that a line cuts off at the side of its neighbour: the integral of max(0, depth +
/// slope·x) over the pixel's width, -½ to ½.
/// @param depth depth of the line in the pixel, at the middle of its width; at most ½
double part_cut_off(double depth, double slope) {
  const double steep = std::abs(slope), lowest = depth - steep / 2, highest = depth + steep / 2;
  if (lowest >= 0) return depth;
  return highest > 0 ? highest * highest / (2 * steep) : 0;
}

/// Collects the pixels that a segment crosses. Along the axis of its longer extent it meets each row or column once,
/// between the middles of two pixels.
void collect(const OutlineSegment& segment, const PixelBox& box, std::span<const float> depth,
             std::span<const std::uint16_t> rgba, std::vector<Blend>& blends) {
  Eigen::Vector3d from = segment.from, to = segment.to;
  const Eigen::Vector3d extent = to - from;
  if (!extent.allFinite()) return;
  // The preference keeps a line of 45 degrees, whose pieces are rounded, from changing axes at each of their ends.
  const int along = 1.02 * std::abs(extent[0]) >= std::abs(extent[1]) ? 0 : 1, across = 1 - along;
  if (extent[along] == 0) return;
  if (extent[along] < 0) std::swap(from, to);
  const Eigen::Vector3d slope = extent / extent[along];
  const auto first_middle = [&](double place) {  // relative to the box
    return static_cast<int>(
        std::ceil(std::clamp(place - 0.5 - box.corner[along], 0.0, static_cast<double>(box.size[along]))));
  };
  const std::array<std::size_t, 2> strides{1, static_cast<std::size_t>(box.size.x())};
  const std::size_t stride = strides[static_cast<std::size_t>(along)], up = strides[static_cast<std::size_t>(across)];
  const int last = first_middle(to[along]);
  for (int k = first_middle(from[along]); k < last; ++k) {
    const Eigen::Vector3d crossing = from + slope * (k + 0.5 + box.corner[along] - from[along]);
    const double place = crossing[across] - 0.5 - box.corner[across];
    if (!(place >= 0 && place < box.size[across] - 1)) continue;
    const auto below = static_cast<std::size_t>(place);
    const std::size_t lower = static_cast<std::size_t>(k) * stride + below * up, upper = lower + up;
    if (double{std::max(depth[lower], depth[upper])} < crossing[2] - hidden_by) continue;
    const double above = place - static_cast<double>(below) - 0.5;  // the boundary between the two pixels
    const auto mix = [&](std::size_t pixel, std::size_t other, double share) {
      if (share == 0) return;
      Blend& blend = blends.emplace_back(Blend{pixel, static_cast<float>(share), {}});
      std::copy_n(rgba.begin() + static_cast<std::ptrdiff_t>(4 * other), 4, blend.neighbor.begin());
    };
    mix(upper, lower, part_cut_off(above, slope[across]));
    mix(lower, upper, part_cut_off(-above, slope[across]));
  }
}

}  // namespace

void smooth_outlines(std::span<const OutlineSegment> outline, const PixelBox& box, std::span<const float> depth,
                     std::span<std::uint16_t> rgba) {
  if (box.empty()) return;
  std::vector<Blend> blends;
  for (const OutlineSegment& segment : outline) collect(segment, box, depth, rgba, blends);
  for (const Blend& blend : blends) {
    for (std::size_t c = 0; c < 4; ++c) {
      std::uint16_t& value = rgba[4 * blend.pixel + c];
      const float own = value;
      const float mixed = own + blend.share * (static_cast<float>(blend.neighbor[c]) - own);
      value = static_cast<std::uint16_t>(std::lround(mixed));
    }
  }
}

}  // namespace drape
