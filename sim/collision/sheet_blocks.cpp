#include "sim/collision/sheet_blocks.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

#include "sim/collision/candidates.hpp"
#include "sim/collision/flat_hull.hpp"

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
        pairs[width][k].setConstant(std::numeric_limits<float>::infinity());
        for (Index m = k; m < most_inside; ++m) {
          const Index a = k % width, b = m % width, across = a < b ? b - a : a - b;
          if (across > 1 || m / width - k / width > 1) pairs[width][k][Eigen::Index(m)] = 0;
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
  auto border = border_of(cloth.triangles);
  if (!border || border->empty()) return false;
  const auto& [a, b, c] = cloth.triangles.front();
  const Eigen::Vector3d origin = rest_of(cloth, a);
  const Eigen::Vector3d normal = (rest_of(cloth, b) - origin).cross(rest_of(cloth, c) - origin).normalized();
  Eigen::Matrix<double, 3, 2> axes;
  axes.col(0) = (rest_of(cloth, border->front()[1]) - rest_of(cloth, border->front()[0])).normalized();
  axes.col(1) = normal.cross(axes.col(0));
  const Vertices from_origin = cloth.rest.rowwise() - origin.transpose();
  flat_ = from_origin * axes;
  same_ = flatness * (flat_.colwise().maxCoeff() - flat_.colwise().minCoeff()).maxCoeff();
  if (!((from_origin * normal).cwiseAbs().maxCoeff() <= same_)) return false;

  const auto hull = hull_of(flat_, *border);
  std::vector<Triangle> all = cloth.triangles;
  const auto filling = filling_of(flat_, *border, hull, same_);
  all.insert(all.end(), filling.begin(), filling.end());
  border = border_of(all);
  if (!border || !is_hull(flat_, *border, hull, same_)) return false;
  cloth_pieces_ = cloth.triangles.size();
  if (!add_pieces(all, area_of(hull))) return false;
  return filling.empty() || keep_apart(cloth);
}

bool SheetBlocks::add_pieces(const std::vector<Triangle>& triangles, double whole) {
  double area = 0;
  least_distance_ = std::numeric_limits<double>::infinity();
  for (const Triangle& t : triangles) {
    Eigen::Matrix2d edges;
    edges << (flat_.row(t[1]) - flat_.row(t[0])).transpose(), (flat_.row(t[2]) - flat_.row(t[0])).transpose();
    const double twice = edges.determinant();
    const double longest = std::max({edges.col(0).norm(), edges.col(1).norm(), (edges.col(1) - edges.col(0)).norm()});
    if (!(twice > same_ * longest)) return false;
    area += twice / 2;
    if (is_cloth(pieces_.size())) least_distance_ = std::min(least_distance_, twice / longest);
    pieces_.push_back({.vertices = t, .inverse = edges.inverse()});
  }
  // Each point of the hull has as many triangles on it as any other, since the border is the hull's.
  return area < 1.5 * whole;
}

bool SheetBlocks::keep_apart(const Cloth& cloth) {
  std::vector<Point> places;
  for (int i = 0; i < cloth.vertex_count(); ++i) places.push_back(rest_of(cloth, i));
  CollisionCandidates near(cloth);
  near.find(places, places, least_distance_);
  for (const auto& [feature, vertices] : near.pairs()) {
    least_distance_ = std::min(least_distance_, std::sqrt(nearest(feature, gather(places, vertices)).squared));
  }
  return least_distance_ > same_;
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
    for (const Index p : pieces) {
      if (is_cloth(p)) vertices.insert(vertices.end(), pieces_[p].vertices.begin(), pieces_[p].vertices.end());
    }
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
