#include "sim/collision/sheet_blocks.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

namespace drape {
namespace {

using Index = std::size_t;
using Places = std::vector<double>;

constexpr double flatness = 1e-9;  // what is no difference in the rectangle, as a part of its size
// Blocks with fewer triangles are not measured, but those around them: their borders would be measured too often.
constexpr Index least_measured = 12;

Eigen::Vector3d rest_of(const Cloth& cloth, int i) { return cloth.rest.row(i).transpose(); }

/// The vertices' places along an axis, each once.
Places places_along(const Eigen::Ref<const Eigen::VectorXd>& axis, double same) {
  Places places(axis.begin(), axis.end());
  std::sort(places.begin(), places.end());
  places.erase(std::unique(places.begin(), places.end(), [&](double a, double b) { return b - a <= same; }),
               places.end());
  return places;
}

using Corner = Eigen::RowVector2d;

double cross(const Corner& a, const Corner& b) { return a[0] * b[1] - a[1] * b[0]; }

/// The corners of the convex hull, counterclockwise (Andrew 1979).
std::vector<Corner> convex_hull(std::vector<Corner> points) {
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

/// Where so many blocks begin and end, with as many places in each: a power of two, or all places.
Places borders(const Places& places, Index most) {
  const Index count = std::min(most, places.size() - 1);
  Places borders;
  for (Index k = 0; k <= count; ++k) borders.push_back(places[k * (places.size() - 1) / count]);
  return borders;
}

/// The blocks between borders that something from `low` to `high` reaches into.
SheetBlocks::Range reached(const Places& borders, double low, double high, double same) {
  const auto first = std::upper_bound(borders.begin() + 1, borders.end() - 1, low + same) - borders.begin() - 1;
  const auto last = std::lower_bound(borders.begin() + 1, borders.end() - 1, high - same) - borders.begin();
  return {static_cast<Index>(first), static_cast<Index>(last)};
}

}  // namespace

SheetBlocks::Part SheetBlocks::Level::window(Index column, Index row) const {
  return {.columns = {column, std::min(column + 2, columns())}, .rows = {row, std::min(row + 2, rows())}};
}

SheetBlocks::Part SheetBlocks::Level::part_of(Index block) const {
  const Index column = block % columns(), row = block / columns();
  return {.columns = {column, column + 1}, .rows = {row, row + 1}};
}

SheetBlocks::Part SheetBlocks::Level::inside(const Part& part) const {
  const std::vector<Index>&across = axes[0].children, &up = axes[1].children;
  return {.columns = {across[part.columns.first], across[part.columns.last]},
          .rows = {up[part.rows.first], up[part.rows.last]}};
}

const SheetBlocks::Pairs& SheetBlocks::pairs_apart(Index columns) {
  static const auto all = [] {
    std::array<Pairs, 5> pairs{};
    for (Index width = 1; width < pairs.size(); ++width) {
      for (Index k = 0; k < most_inside; ++k) {
        for (Index m = k; m < most_inside; ++m) {
          const Index a = k % width, b = m % width, across = a < b ? b - a : a - b;
          pairs[width][k][m] = static_cast<int>(across > 1 || m / width - k / width > 1);
        }
      }
    }
    return pairs;
  }();
  return all[columns];
}

std::optional<SheetBlocks> SheetBlocks::of(const Cloth& cloth) {
  SheetBlocks sheet;
  if (cloth.triangles.empty() || !sheet.lay_flat(cloth)) return std::nullopt;
  sheet.divide();
  sheet.weigh_edges();
  return sheet;
}

bool SheetBlocks::lay_flat(const Cloth& cloth) {
  // Edges with the triangle on their left, and how often they are there.
  std::map<Edge, int> sides;
  for (const auto& [a, b, c] : cloth.triangles) {
    for (const Edge side : {Edge{a, b}, Edge{b, c}, Edge{c, a}}) {
      if (++sides[side] > 1 || side[0] == side[1]) return false;
    }
  }
  std::vector<Edge> border;
  for (const auto& [side, count] : sides) {
    if (!sides.contains(Edge{side[1], side[0]})) border.push_back(side);
  }
  if (border.empty()) return false;

  const auto& [a, b, c] = cloth.triangles.front();
  const Eigen::Vector3d origin = rest_of(cloth, a);
  const Eigen::Vector3d normal = (rest_of(cloth, b) - origin).cross(rest_of(cloth, c) - origin).normalized();
  Eigen::Matrix<double, 3, 2> axes;
  axes.col(0) = (rest_of(cloth, border.front()[1]) - rest_of(cloth, border.front()[0])).normalized();
  axes.col(1) = normal.cross(axes.col(0));
  const Vertices from_origin = cloth.rest.rowwise() - origin.transpose();
  flat_ = from_origin * axes;
  same_ = flatness * (flat_.colwise().maxCoeff() - flat_.colwise().minCoeff()).maxCoeff();
  if (!((from_origin * normal).cwiseAbs().maxCoeff() <= same_)) return false;
  std::vector<Corner> ends;
  for (const Edge& side : border) ends.emplace_back(flat_.row(side[0]));
  const std::vector<Corner> hull = convex_hull(std::move(ends));
  for (const Edge& side : border) {
    const Corner start = flat_.row(side[0]), along = flat_.row(side[1]) - start;
    const double outside = -same_ * along.norm();
    const bool all_inside = std::all_of(hull.begin(), hull.end(),
                                        [&](const Corner& corner) { return cross(along, corner - start) >= outside; });
    if (!all_inside) return false;
  }
  return add_pieces(cloth, same_, area_of(hull));
}

bool SheetBlocks::add_pieces(const Cloth& cloth, double same, double whole) {
  double area = 0;
  least_height_ = std::numeric_limits<double>::infinity();
  for (const Triangle& t : cloth.triangles) {
    Eigen::Matrix2d edges;
    edges << (flat_.row(t[1]) - flat_.row(t[0])).transpose(), (flat_.row(t[2]) - flat_.row(t[0])).transpose();
    const double twice = edges.determinant();
    const double longest = std::max({edges.col(0).norm(), edges.col(1).norm(), (edges.col(1) - edges.col(0)).norm()});
    if (!(twice > same * longest)) return false;
    area += twice / 2;
    least_height_ = std::min(least_height_, twice / longest);
    pieces_.push_back({.vertices = t, .inverse = edges.inverse()});
  }
  // Each point of the hull has as many triangles on it as any other, since the border is the hull's.
  return area < 1.5 * whole;
}

void SheetBlocks::divide() {
  const std::array<Places, 2> places{places_along(flat_.col(0), same_), places_along(flat_.col(1), same_)};
  for (Index most = 2;; most *= 2) {
    Level level;
    for (Index k = 0; k < 2; ++k) level.axes[k].borders = borders(places[k], most);
    const bool finer =
        levels_.empty() || level.columns() > levels_.back().columns() || level.rows() > levels_.back().rows();
    const Index blocks = level.columns() * level.rows();
    if (!finer || (!levels_.empty() && blocks > pieces_.size() / 2)) break;
    if (pieces_.size() >= least_measured * blocks) measured_ = levels_.size();
    fill(level);
    levels_.push_back(std::move(level));
  }
  for (Index l = 0; l < levels_.size(); ++l) {
    for (Index k = 0; k < 2; ++k) {
      Axis& axis = levels_[l].axes[k];
      const Places& next = levels_[std::min(l + 1, levels_.size() - 1)].axes[k].borders;
      const Places& measured = levels_[measured_].axes[k].borders;
      for (const double border : axis.borders) {
        axis.children.push_back(static_cast<Index>(std::lower_bound(next.begin(), next.end(), border) - next.begin()));
      }
      for (Index b = 0; b < axis.blocks(); ++b) {
        axis.measured.push_back(reached(measured, axis.borders[b], axis.borders[b + 1], same_));
      }
    }
  }
}

void SheetBlocks::fill(Level& level) const {
  const Index count = level.columns() * level.rows();
  std::vector<std::vector<Index>> inside(count);
  for (Index p = 0; p < pieces_.size(); ++p) {
    const auto& [a, b, c] = pieces_[p].vertices;
    const Eigen::RowVector2d low = flat_.row(a).cwiseMin(flat_.row(b)).cwiseMin(flat_.row(c));
    const Eigen::RowVector2d high = flat_.row(a).cwiseMax(flat_.row(b)).cwiseMax(flat_.row(c));
    const Range columns = reached(level.axes[0].borders, low[0], high[0], same_);
    const Range rows = reached(level.axes[1].borders, low[1], high[1], same_);
    for (Index row = rows.first; row < rows.last; ++row) {
      for (Index column = columns.first; column < columns.last; ++column) {
        inside[row * level.columns() + column].push_back(p);
      }
    }
  }
  for (const std::vector<Index>& pieces : inside) {
    level.first_piece.push_back(level.pieces.size());
    level.first_vertex.push_back(level.vertices.size());
    level.pieces.insert(level.pieces.end(), pieces.begin(), pieces.end());
    std::vector<int> vertices;
    for (const Index p : pieces)
      vertices.insert(vertices.end(), pieces_[p].vertices.begin(), pieces_[p].vertices.end());
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    level.vertices.insert(level.vertices.end(), vertices.begin(), vertices.end());
  }
  level.first_piece.push_back(level.pieces.size());
  level.first_vertex.push_back(level.vertices.size());
}

void SheetBlocks::weigh_edges() {
  // In a triangle of area A, ‖∂u/∂p‖² = Σ cot θ ‖uᵢ − uⱼ‖² / 2A, θ the angle opposite to the edge (Pinkall and Polthier
  // 1993): at most the largest term that is positive, as often as there are such.
  const Level& level = measured();
  for (Index block = 0; block < level.columns() * level.rows(); ++block) {
    first_edge_.push_back(edges_.size());
    std::map<Edge, double> weights;
    for (const Index p : level.pieces_of(block)) {
      const Triangle& t = pieces_[p].vertices;
      const double twice = 1 / pieces_[p].inverse.determinant();
      std::array<double, 3> terms{};
      for (Index k = 0; k < 3; ++k) {
        const Eigen::RowVector2d corner = flat_.row(t[k]);
        const double cosine = (flat_.row(t[(k + 1) % 3]) - corner).dot(flat_.row(t[(k + 2) % 3]) - corner);
        terms[k] = cosine / (twice * twice);
      }
      const double least = flatness * *std::max_element(terms.begin(), terms.end());
      const auto positive = std::count_if(terms.begin(), terms.end(), [&](double term) { return term > least; });
      for (Index k = 0; k < 3; ++k) {
        const auto [i, j] = std::minmax(t[(k + 1) % 3], t[(k + 2) % 3]);
        // A little more than that, for what was left out.
        const double weight = (1 + 4 * flatness) * static_cast<double>(positive) * terms[k];
        if (terms[k] > least) weights[{i, j}] = std::max(weights[{i, j}], weight);
      }
    }
    for (const auto& [edge, weight] : weights) edges_.push_back({edge[0], edge[1], weight});
  }
  first_edge_.push_back(edges_.size());
}

}  // namespace drape
