#include "sim/collision/smooth_sheet.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <span>

namespace drape {
namespace {

using Index = std::size_t;

// Along each side of the rectangle. More are smoother each, and have more pairs of balls to compare.
constexpr std::array<Index, 4> block_counts{1, 6, 12, 20};
constexpr int most_pause = 16;  // steps
// By how much more than it moves something has to be apart, for a fifth of every distance to be left.
constexpr double moving_margin = 1.25;
constexpr double unlimited = std::numeric_limits<double>::infinity();
constexpr double flatness = 1e-9;  // what is no difference in the rectangle, as a part of its size

Eigen::Vector3d rest_of(const Cloth& cloth, int i) { return cloth.rest.row(i).transpose(); }

/// Where columns or rows of blocks begin and end: at some of the vertices' places along an axis, with as many in each.
std::vector<double> borders(const Eigen::Ref<const Eigen::VectorXd>& along, Index most, double same) {
  std::vector<double> places(along.begin(), along.end());
  std::sort(places.begin(), places.end());
  places.erase(std::unique(places.begin(), places.end(), [&](double a, double b) { return b - a <= same; }),
               places.end());
  const Index count = std::min(most, places.size() - 1);
  std::vector<double> borders;
  for (Index k = 0; k <= count; ++k) borders.push_back(places[k * (places.size() - 1) / count]);
  return borders;
}

}  // namespace

SmoothSheet::SmoothSheet(const Cloth& cloth) {
  if (cloth.triangles.empty() || !lay_flat(cloth)) return;
  for (const Index count : block_counts) {
    Division division = divided(count);
    if (divisions_.empty() || division.blocks.size() > divisions_.back().blocks.size()) {
      divisions_.push_back(std::move(division));
    }
  }
}

bool SmoothSheet::lay_flat(const Cloth& cloth) {
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
  const Point origin = rest_of(cloth, a);
  const Point normal = (rest_of(cloth, b) - origin).cross(rest_of(cloth, c) - origin).normalized();
  Eigen::Matrix<double, 3, 2> axes;
  axes.col(0) = (rest_of(cloth, border.front()[1]) - rest_of(cloth, border.front()[0])).normalized();
  axes.col(1) = normal.cross(axes.col(0));
  const Vertices from_origin = cloth.rest.rowwise() - origin.transpose();
  flat_ = from_origin * axes;
  const Eigen::RowVector2d low = flat_.colwise().minCoeff(), high = flat_.colwise().maxCoeff();
  const double same = flatness * (high - low).maxCoeff();
  if (!((from_origin * normal).cwiseAbs().maxCoeff() <= same)) return false;

  for (const Edge& side : border) {
    const auto both_at = [&](int axis, double place) {
      return std::abs(flat_(side[0], axis) - place) <= same && std::abs(flat_(side[1], axis) - place) <= same;
    };
    if (!both_at(0, low[0]) && !both_at(0, high[0]) && !both_at(1, low[1]) && !both_at(1, high[1])) return false;
  }
  double area = 0;
  least_height_ = unlimited;
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
  // Each point of the rectangle has as many triangles on it as any other, since the border is the rectangle's.
  const double whole = (high - low).prod();
  return area < 1.5 * whole;
}

SmoothSheet::Division SmoothSheet::divided(Index most) const {
  const double same = flatness * (flat_.colwise().maxCoeff() - flat_.colwise().minCoeff()).maxCoeff();
  const std::array<std::vector<double>, 2> at{borders(flat_.col(0), most, same), borders(flat_.col(1), most, same)};
  Division division;
  division.columns = at[0].size() - 1;
  division.rows = at[1].size() - 1;
  for (Index k = 0; k < division.columns * division.rows; ++k) {
    const Index column = k % division.columns, row = k / division.columns;
    const Eigen::RowVector2d low(at[0][column], at[1][row]), high(at[0][column + 1], at[1][row + 1]);
    Block block{.first_piece = division.pieces.size(), .first_vertex = division.vertices.size()};
    for (Index p = 0; p < pieces_.size(); ++p) {
      const auto& [a, b, c] = pieces_[p].vertices;
      const Eigen::RowVector2d from = flat_.row(a).cwiseMin(flat_.row(b)).cwiseMin(flat_.row(c));
      const Eigen::RowVector2d to = flat_.row(a).cwiseMax(flat_.row(b)).cwiseMax(flat_.row(c));
      if (((from - high).array() >= -same).any() || ((low - to).array() >= -same).any()) continue;
      division.pieces.push_back(p);
      division.vertices.insert(division.vertices.end(), {a, b, c});
    }
    const auto first = division.vertices.begin() + static_cast<std::ptrdiff_t>(block.first_vertex);
    std::sort(first, division.vertices.end());
    division.vertices.erase(std::unique(first, division.vertices.end()), division.vertices.end());
    block.last_piece = division.pieces.size();
    block.last_vertex = division.vertices.size();
    division.blocks.push_back(block);
  }
  Balls& balls = division.balls;
  balls.all.resize(division.blocks.size());
  for (auto* values : {&balls.x, &balls.y, &balls.z, &balls.reach}) values->resize(division.blocks.size());
  return division;
}

bool SmoothSheet::stays_apart(const std::vector<Point>& from, double h, const std::vector<Point>& velocities,
                              double distance) {
  if (divisions_.empty() || pause_-- > 0) return false;
  load(from, h, velocities);
  const double ratio = distance / least_height_;
  // What did last may do again, and if it does, perhaps less does the next time.
  for (Index k = last_; k < divisions_.size(); ++k) {
    Division& division = divisions_[k];
    if (!windows_are_smooth(division, ratio)) continue;
    if (k > 0 && !blocks_are_apart(division, from, h, velocities, distance)) continue;
    last_ = k > last_ || k == 0 ? k : k - 1;
    failures_ = 0;
    pause_ = 0;
    return true;
  }
  last_ = 0;
  failures_ = std::min(failures_ + 1, most_pause);
  pause_ = failures_;
  return false;
}

void SmoothSheet::load(const std::vector<Point>& from, double h, const std::vector<Point>& velocities) {
  for (Piece& piece : pieces_) {
    const auto a = Index(piece.vertices[0]), b = Index(piece.vertices[1]), c = Index(piece.vertices[2]);
    Gradient edges, moves;
    edges << from[b] - from[a], from[c] - from[a];
    moves << velocities[b] - velocities[a], velocities[c] - velocities[a];
    piece.gradient.noalias() = edges * piece.inverse;
    piece.changed = h * h * (moves * piece.inverse).squaredNorm();
  }
}

bool SmoothSheet::windows_are_smooth(Division& division, double ratio) const {
  for (Block& block : division.blocks) {
    block.sum.setZero();
    block.changed = 0;
    for (Index e = block.first_piece; e < block.last_piece; ++e) {
      const Piece& piece = pieces_[division.pieces[e]];
      block.sum += piece.gradient;
      block.changed = std::max(block.changed, piece.changed);
    }
  }
  const Index columns = division.columns, rows = division.rows;
  for (Index row = 0; row == 0 || row + 1 < rows; ++row) {
    for (Index column = 0; column == 0 || column + 1 < columns; ++column) {
      const Index right = std::min(column + 1, columns - 1), above = std::min(row + 1, rows - 1);
      const std::array<Index, 4> window{row * columns + column, row * columns + right, above * columns + column,
                                        above * columns + right};
      if (!smooth(division, window, ratio)) return false;
    }
  }
  return true;
}

bool SmoothSheet::smooth(const Division& division, const std::array<Index, 4>& window, double ratio) const {
  Gradient mean = Gradient::Zero();
  double changed = 0;
  for (const Index k : window) {
    mean += division.blocks[k].sum;
    changed = std::max(changed, division.blocks[k].changed);
  }
  // The nearest matrix with orthonormal columns: the root of a 2×2 matrix M is (M + √det M)/√(tr M + 2√det M).
  const Eigen::Matrix2d square = mean.transpose() * mean;
  const double root = std::sqrt(std::max(0.0, square.determinant()));
  if (!(root > 0)) return false;
  const Eigen::Matrix2d sum = square + root * Eigen::Matrix2d::Identity();
  const Gradient axes = mean * sum.inverse() * std::sqrt(square.trace() + 2 * root);
  const double least = ratio + moving_margin * std::sqrt(changed);
  for (Index w = 0; w < window.size(); ++w) {
    if (std::find(window.begin(), window.begin() + static_cast<std::ptrdiff_t>(w), window[w]) !=
        window.begin() + static_cast<std::ptrdiff_t>(w)) {
      continue;  // there is but one row or column
    }
    const Block& block = division.blocks[window[w]];
    for (Index e = block.first_piece; e < block.last_piece; ++e) {
      const Gradient& f = pieces_[division.pieces[e]].gradient;
      const double a = axes.col(0).dot(f.col(0)) - least, b = axes.col(1).dot(f.col(1)) - least;
      const double c = (axes.col(0).dot(f.col(1)) + axes.col(1).dot(f.col(0))) / 2;
      if (!(a > 0 && a * b >= c * c)) return false;
    }
  }
  return true;
}

bool SmoothSheet::blocks_are_apart(Division& division, const std::vector<Point>& from, double h,
                                   const std::vector<Point>& velocities, double distance) const {
  Point together = Point::Zero();  // [m/s]: brings nothing together
  for (const Point& velocity : velocities) together += velocity;
  together /= static_cast<double>(velocities.size());
  for (Index k = 0; k < division.blocks.size(); ++k) {
    division.balls.set(k, ball_around(division, k, from, h, velocities, distance), h * moving_margin, together);
  }
  // Those after it that are in no window with it: the rest of its row and of the next, and all others.
  const Balls& balls = division.balls;
  const Index columns = division.columns, count = division.blocks.size();
  for (Index k = 0; k < count; ++k) {
    const Index column = k % columns, next = k - column + columns, rest = std::min(next + columns, count);
    if (!balls.apart(k, std::min(k + 2, next), next) || !balls.apart(k, rest, count)) return false;
    if (next == count) continue;
    if (!balls.apart(k, next, next + (column > 0 ? column - 1 : 0))) return false;
    if (!balls.apart(k, std::min(next + column + 2, rest), rest)) return false;
  }
  return true;
}

SmoothSheet::Ball SmoothSheet::ball_around(const Division& division, Index k, const std::vector<Point>& from, double h,
                                           const std::vector<Point>& velocities, double distance) {
  const Block& block = division.blocks[k];
  const std::span<const int> vertices(division.vertices.data() + block.first_vertex,
                                      block.last_vertex - block.first_vertex);
  Point low = Point::Constant(unlimited), high = -low, slow = low, fast = -low;
  for (const int i : vertices) {
    low = low.cwiseMin(from[Index(i)]);
    high = high.cwiseMax(from[Index(i)]);
    slow = slow.cwiseMin(velocities[Index(i)]);
    fast = fast.cwiseMax(velocities[Index(i)]);
  }
  Ball ball{.middle = (low + high) / 2, .velocity = (slow + fast) / 2, .radius = 0};
  double widest = 0, fastest = 0;
  for (const int i : vertices) {
    widest = std::max(widest, (from[Index(i)] - ball.middle).squaredNorm());
    fastest = std::max(fastest, (velocities[Index(i)] - ball.velocity).squaredNorm());
  }
  ball.radius = std::sqrt(widest) + distance / 2 + moving_margin * h * std::sqrt(fastest);
  return ball;
}

void SmoothSheet::Balls::set(Index k, const Ball& ball, double way, const Point& together) {
  all[k] = ball;
  time = way;
  x[k] = ball.middle.x();
  y[k] = ball.middle.y();
  z[k] = ball.middle.z();
  reach[k] = ball.radius + way * (ball.velocity - together).norm();
}

bool SmoothSheet::Balls::apart(Index k, Index first, Index last) const {
  int near = 0;
  for (Index l = first; l < last; ++l) {
    const double dx = x[l] - x[k], dy = y[l] - y[k], dz = z[l] - z[k], sum = reach[l] + reach[k];
    near |= static_cast<int>(dx * dx + dy * dy + dz * dz <= sum * sum);
  }
  if (near == 0) return true;
  for (Index l = first; l < last; ++l) {
    const Ball &a = all[k], &b = all[l];
    const double needed = a.radius + b.radius + time * (a.velocity - b.velocity).norm();
    if ((a.middle - b.middle).squaredNorm() <= needed * needed) return false;
  }
  return true;
}

}  // namespace drape
