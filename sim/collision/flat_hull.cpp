#include "sim/collision/flat_hull.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <utility>

namespace drape {
namespace {

using Index = std::size_t;
using Corner = Eigen::RowVector2d;
using Polygon = std::vector<int>;  // counterclockwise

double cross(const Corner& a, const Corner& b) { return a[0] * b[1] - a[1] * b[0]; }

/// Whether a point is left of a line through two, or so far to its right.
bool is_left(const Corner& point, const Corner& from, const Corner& to, double same) {
  return cross(to - from, point - from) >= -same * (to - from).norm();
}

/// A border's sides one after another; nothing where a vertex is passed twice.
std::vector<Polygon> loops_of(const std::vector<Edge>& border) {
  std::map<int, int> next;
  for (const Edge& side : border) {
    if (!next.emplace(side[0], side[1]).second) return {};
  }
  std::vector<Polygon> loops;
  while (!next.empty()) {
    Polygon& loop = loops.emplace_back();
    for (auto side = next.begin(); side != next.end(); side = next.find(loop.back())) {
      if (loop.empty()) loop.push_back(side->first);
      loop.push_back(side->second);
      next.erase(side);
    }
    loop.pop_back();  // where it began
  }
  return loops;
}

/// Cuts triangles off a polygon until it is one.
class EarCutter {
 public:
  EarCutter(const FlatPlaces& flat, double same) : flat_(flat), same_(same) {}

  void cut(Polygon polygon, std::vector<Triangle>& ears) const {
    // Not one beside the other, which would make a fan of slivers.
    for (Index k = 0, refused = 0; polygon.size() > 3 && refused < polygon.size();) {
      k %= polygon.size();
      const Triangle ear = corners(polygon, k);
      if (!is_ear(polygon, ear)) {
        ++k;
        ++refused;
        continue;
      }
      ears.push_back(ear);
      polygon.erase(polygon.begin() + static_cast<std::ptrdiff_t>(k));
      ++k;
      refused = 0;
    }
    if (polygon.size() == 3) ears.push_back({polygon[0], polygon[1], polygon[2]});
  }

 private:
  [[nodiscard]] Corner at(int i) const { return flat_.row(i); }
  static Triangle corners(const Polygon& polygon, Index k) {
    const Index count = polygon.size();
    return {polygon[(k + count - 1) % count], polygon[k], polygon[(k + 1) % count]};
  }
  [[nodiscard]] bool is_ear(const Polygon& polygon, const Triangle& ear) const {
    const Corner a = at(ear[0]), b = at(ear[1]), c = at(ear[2]);
    const double longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
    if (!(cross(b - a, c - a) > 2 * same_ * longest)) return false;
    return std::none_of(polygon.begin(), polygon.end(), [&](int i) {
      return i != ear[0] && i != ear[1] && i != ear[2] && is_left(at(i), a, b, same_) && is_left(at(i), b, c, same_) &&
             is_left(at(i), c, a, same_);
    });
  }

  const FlatPlaces& flat_;
  double same_;
};

/// What is between a border and its hull, as polygons: begins and ends where the border leaves the hull.
std::vector<Polygon> notches_of(const Polygon& loop, const FlatPlaces& flat, const std::vector<Corner>& hull,
                                double same) {
  const auto on_hull = [&](int i) {
    for (Index k = 0; k < hull.size(); ++k) {
      if (is_left(flat.row(i), hull[(k + 1) % hull.size()], hull[k], same)) return true;
    }
    return false;
  };
  const auto first = std::find_if(loop.begin(), loop.end(), on_hull);
  Polygon from_hull(first, loop.end());
  from_hull.insert(from_hull.end(), loop.begin(), first);
  if (from_hull.empty() || first == loop.end()) return {};
  from_hull.push_back(from_hull.front());
  std::vector<Polygon> notches;
  Polygon chain;
  for (const int i : from_hull) {
    chain.push_back(i);
    if (chain.size() == 1 || !on_hull(i)) continue;
    if (chain.size() > 2) notches.emplace_back(chain.rbegin(), chain.rend());
    chain = {i};
  }
  return notches;
}

}  // namespace

std::optional<std::vector<Edge>> border_of(const std::vector<Triangle>& triangles) {
  std::map<Edge, int> sides;
  for (const auto& [a, b, c] : triangles) {
    for (const Edge side : {Edge{a, b}, Edge{b, c}, Edge{c, a}}) {
      if (++sides[side] > 1 || side[0] == side[1]) return std::nullopt;
    }
  }
  std::vector<Edge> border;
  for (const auto& [side, count] : sides) {
    if (!sides.contains(Edge{side[1], side[0]})) border.push_back(side);
  }
  return border;
}

std::vector<Corner> hull_of(const FlatPlaces& flat, const std::vector<Edge>& border) {
  std::vector<Corner> points;
  for (const Edge& side : border) points.emplace_back(flat.row(side[0]));
  const auto before = [](const Corner& a, const Corner& b) { return std::pair(a[0], a[1]) < std::pair(b[0], b[1]); };
  std::sort(points.begin(), points.end(), before);
  std::vector<Corner> hull;
  const auto add_side = [&] {
    const Index first = hull.size();
    for (const Corner& point : points) {
      while (hull.size() >= first + 2 && cross(hull.back() - hull[hull.size() - 2], point - hull.back()) <= 0) {
        hull.pop_back();
      }
      hull.push_back(point);
    }
    hull.pop_back();  // where the other side begins
  };
  add_side();
  std::reverse(points.begin(), points.end());
  add_side();
  return hull;
}

double area_of(const std::vector<Corner>& corners) {
  double twice = 0;
  for (Index k = 0; k < corners.size(); ++k) twice += cross(corners[k], corners[(k + 1) % corners.size()]);
  return twice / 2;
}

bool is_hull(const FlatPlaces& flat, const std::vector<Edge>& border, const std::vector<Corner>& hull, double same) {
  return std::all_of(border.begin(), border.end(), [&](const Edge& side) {
    return std::all_of(hull.begin(), hull.end(), [&](const Corner& corner) {
      return is_left(corner, flat.row(side[0]), flat.row(side[1]), same);
    });
  });
}

std::vector<Triangle> filling_of(const FlatPlaces& flat, const std::vector<Edge>& border,
                                 const std::vector<Corner>& hull, double same) {
  const EarCutter cutter(flat, same);
  std::vector<Triangle> filling;
  for (const Polygon& loop : loops_of(border)) {
    std::vector<Corner> corners;
    for (const int i : loop) corners.emplace_back(flat.row(i));
    if (area_of(corners) < 0) {  // a hole: what is on the left is outside
      cutter.cut({loop.rbegin(), loop.rend()}, filling);
      continue;
    }
    for (const Polygon& notch : notches_of(loop, flat, hull, same)) cutter.cut(notch, filling);
  }
  return filling;
}

}  // namespace drape
