#include "sim/collision/smooth_sheet.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/collision/impact.hpp"

namespace drape {
namespace {

using Index = std::size_t;

constexpr int most_pause = 16;  // steps
// Of a block's triangles about so many say how it lies.
constexpr Index most_sampled = 2;
// Features that are compared one by one in a step for each vertex, at most: a search costs more only then.
constexpr int compared_per_vertex = 4;
// By how much F has to change before a window that was not smooth is looked at again.
constexpr double least_used = 0.2;
constexpr double unlimited = std::numeric_limits<double>::infinity();

/// The smaller eigenvalue of the symmetric part of a 2×2 matrix.
double least_of_symmetric_part(double xx, double xy, double yx, double yy) {
  const double half = (xx - yy) / 2, across = (xy + yx) / 2;
  return (xx + yy) / 2 - std::sqrt(half * half + across * across);
}

using Range = SheetBlocks::Range;

Range around(const Range& a, const Range& b) { return {std::min(a.first, b.first), std::max(a.last, b.last)}; }

}  // namespace

SmoothSheet::SmoothSheet(const Cloth& cloth) : sheet_(SheetBlocks::of(cloth)) {
  if (!sheet_) return;
  for (const SheetBlocks::Level& level : sheet_->levels()) {
    LevelState state;
    state.columns = std::max<Index>(level.columns() - 1, 1);
    state.windows.resize(state.columns * std::max<Index>(level.rows() - 1, 1));
    state.balls.resize(level.columns() * level.rows());
    levels_.push_back(std::move(state));
  }
  changes_.resize(sheet_->measured().columns() * sheet_->measured().rows());
}

bool SmoothSheet::stays_apart(const Vertices& x, double h, const Vertices& v, double distance) {
  if (!sheet_ || pause_-- > 0) return false;
  // What has not been visited in the call before is looked at anew.
  calls_ += distance == distance_ ? 1 : 2;
  distance_ = distance;
  measure(x, h, v);
  allowance_ = compared_per_vertex * static_cast<int>(x.rows());
  const bool apart = window_is_apart(0, 0, 0);
  failures_ = apart ? 0 : std::min(failures_ + 1, most_pause);
  pause_ = failures_;
  return apart;
}

void SmoothSheet::measure(const Vertices& x, double h, const Vertices& v) {
  const bool first = vertices_.empty();
  vertices_.resize(static_cast<Index>(x.rows()));
  for (Eigen::Index k = 0; k < 3; ++k) {
    const double *now = x.col(k).data(), *velocity = v.col(k).data();
    for (Index i = 0; i < vertices_.size(); ++i) {
      Vertex& vertex = vertices_[i];
      vertex.moved[Index(k)] << (first ? 0 : now[i] - vertex.place[k]), h * velocity[i];
      vertex.place[k] = now[i];
    }
  }
  for (Index block = 0; block < changes_.size(); ++block) {
    Eigen::Array2d most = Eigen::Array2d::Zero();
    for (const auto& [i, j, weight] : sheet_->edges_of(block)) {
      const auto &a = vertices_[Index(i)].moved, &b = vertices_[Index(j)].moved;
      const Eigen::Array2d dx = a[0] - b[0], dy = a[1] - b[1], dz = a[2] - b[2];
      most = most.max(weight * (dx * dx + dy * dy + dz * dz));
    }
    changes_[block] = {.since = std::sqrt(most[0]), .next = std::sqrt(most[1])};
  }
}

SmoothSheet::Change SmoothSheet::change_in(Index l, const Part& part) const {
  const auto& [columns, rows] = sheet_->levels()[l].axes;
  Change most;
  for (Index row = rows.measured[part.rows.first].first; row < rows.measured[part.rows.last - 1].last; ++row) {
    for (Index column = columns.measured[part.columns.first].first;
         column < columns.measured[part.columns.last - 1].last; ++column) {
      const Change& change = changes_[row * sheet_->measured().columns() + column];
      most = {.since = std::max(most.since, change.since), .next = std::max(most.next, change.next)};
    }
  }
  return most;
}

bool SmoothSheet::window_is_apart(Index l, Index column, Index row) {
  Window& window = levels_[l].windows[row * levels_[l].columns + column];
  if (window.seen == calls_) return true;
  const bool known = window.seen + 1 == calls_;
  window.seen = calls_;
  const SheetBlocks::Level& level = sheet_->levels()[l];
  const Part part = level.window(column, row);
  if (level.is_empty(part)) return true;
  const Change change = change_in(l, part);
  window.used += change.since;
  const bool lasts = window.split ? window.used < least_used : window.room.lasts({window.used, change.next});
  if (!known || !lasts) {
    window.used = 0;
    const std::optional<Room> room = smooth(l, part, change, window.first);
    window.split = !room;
    if (room) window.room = *room;
  }
  if (!window.split) return true;
  if (l + 1 == levels_.size()) {
    gather(l, part, features_[0]);
    return features_are_apart(features_[0], features_[0]);
  }
  const Part inner = level.inside(part);
  if (!blocks_are_apart(l + 1, inner)) return false;
  const auto& [columns, rows] = inner;
  for (Index r = rows.first; r == rows.first || r + 1 < rows.last; ++r) {
    for (Index c = columns.first; c == columns.first || c + 1 < columns.last; ++c) {
      if (!window_is_apart(l + 1, c, r)) return false;
    }
  }
  return true;
}

std::optional<SmoothSheet::Room> SmoothSheet::smooth(Index l, const Part& part, const Change& change,
                                                     std::optional<Index>& first) const {
  const auto axes = frame(l, part);
  if (!axes) return std::nullopt;
  const double needed = distance_ / sheet_->least_distance();
  const double least = std::max(needed + change.next, change.next / most_moved);
  const auto least_in = [&](Index p) {
    const auto& [vertices, inverse] = sheet_->pieces()[p];
    const Point corner = place(vertices[0]);
    const Eigen::Vector2d a = axes->transpose() * (place(vertices[1]) - corner);
    const Eigen::Vector2d b = axes->transpose() * (place(vertices[2]) - corner);
    return least_of_symmetric_part(
        a[0] * inverse(0, 0) + b[0] * inverse(1, 0), a[0] * inverse(0, 1) + b[0] * inverse(1, 1),
        a[1] * inverse(0, 0) + b[1] * inverse(1, 0), a[1] * inverse(0, 1) + b[1] * inverse(1, 1));
  };
  if (first && !(least_in(*first) >= least)) return std::nullopt;
  double found = unlimited;
  const bool all = sheet_->levels()[l].all_pieces(part, [&](Index p) {
    found = std::min(found, least_in(p));
    if (found < least) first = p;
    return found >= least;
  });
  if (!all) return std::nullopt;
  return Room{.whole = found, .beyond = found - needed};
}

std::optional<SmoothSheet::Gradient> SmoothSheet::frame(Index l, const Part& part) const {
  const SheetBlocks::Level& level = sheet_->levels()[l];
  Gradient mean = Gradient::Zero();
  for (Index row = part.rows.first; row < part.rows.last; ++row) {
    for (Index column = part.columns.first; column < part.columns.last; ++column) {
      const auto pieces = level.pieces_of(row * level.columns() + column);
      for (Index k = 0; k < pieces.size(); k += 1 + pieces.size() / most_sampled) {
        const auto& [vertices, inverse] = sheet_->pieces()[pieces[k]];
        Gradient edges;
        edges << place(vertices[1]) - place(vertices[0]), place(vertices[2]) - place(vertices[0]);
        mean += edges * inverse;
      }
    }
  }
  // The nearest matrix with orthonormal columns: the root of a 2×2 matrix M is (M + √det M)/√(tr M + 2√det M).
  const Eigen::Matrix2d square = mean.transpose() * mean;
  const double root = std::sqrt(std::max(0.0, square.determinant()));
  if (!(root > 0)) return std::nullopt;
  const Eigen::Matrix2d sum = square + root * Eigen::Matrix2d::Identity();
  return mean * sum.inverse() * std::sqrt(square.trace() + 2 * root);
}

bool SmoothSheet::blocks_are_apart(Index l, const Part& part) {
  const Index width = part.columns.last - part.columns.first, count = width * (part.rows.last - part.rows.first);
  std::array<Index, SheetBlocks::most_inside> blocks{};
  std::array<double, SheetBlocks::most_inside> x{}, y{}, z{}, reach{};
  Point together = Point::Zero();  // what they all do brings nothing together
  for (Index k = 0; k < count; ++k) {
    blocks[k] = (part.rows.first + k / width) * sheet_->levels()[l].columns() + part.columns.first + k % width;
    together += ball(l, blocks[k]).way;
  }
  together /= static_cast<double>(count);
  for (Index k = 0; k < count; ++k) {
    const Ball& ball = levels_[l].balls[blocks[k]];
    x[k] = ball.middle.x();
    y[k] = ball.middle.y();
    z[k] = ball.middle.z();
    reach[k] = ball.radius + distance_ / 2 + ((ball.way - together).norm() + ball.spread) / most_moved;
  }
  const SheetBlocks::Pairs& far = SheetBlocks::pairs_apart(width);
  for (Index k = 0; k + 1 < count; ++k) {
    int near = 0;
    for (Index m = k + 1; m < count; ++m) {
      const double dx = x[m] - x[k], dy = y[m] - y[k], dz = z[m] - z[k], sum = reach[m] + reach[k];
      near |= static_cast<int>(dx * dx + dy * dy + dz * dz <= sum * sum) & far[k][m];
    }
    for (Index m = k + 1; near != 0 && m < count; ++m) {
      if (far[k][m] != 0 && !pair_is_apart(l, {blocks[k], blocks[m]})) return false;
    }
  }
  return true;
}

bool SmoothSheet::pair_is_apart(Index l, const Pair& pair) {
  const SheetBlocks::Level& level = sheet_->levels()[l];
  const auto& [first, second] = pair;
  const Part a = level.part_of(first), b = level.part_of(second);
  if (level.is_empty(a) || level.is_empty(b)) return true;
  const Part between{.columns = around(a.columns, b.columns), .rows = around(a.rows, b.rows)};
  const Ball &at = ball(l, first), &other = ball(l, second);
  const double moved = (at.way - other.way).norm() + at.spread + other.spread;
  const double enough = std::max(distance_ + moved, moved / most_moved);
  if (gap(l, pair, enough) >= enough) return true;
  if (l + 1 == levels_.size()) {
    std::optional<Index> unused;
    if (smooth(l, between, change_in(l, between), unused)) return true;
    gather(l, a, features_[0]);
    gather(l, b, features_[1]);
    return features_are_apart(features_[0], features_[1]);
  }
  const Part inner = level.inside(a), others = level.inside(b);
  const Index width = sheet_->levels()[l + 1].columns();
  for (Index row = inner.rows.first; row < inner.rows.last; ++row) {
    for (Index column = inner.columns.first; column < inner.columns.last; ++column) {
      for (Index r = others.rows.first; r < others.rows.last; ++r) {
        for (Index c = others.columns.first; c < others.columns.last; ++c) {
          if (!pair_is_apart(l + 1, {row * width + column, r * width + c})) return false;
        }
      }
    }
  }
  return true;
}

double SmoothSheet::gap(Index l, const Pair& pair, double enough) {
  const Ball &a = ball(l, pair.first), &b = ball(l, pair.second);
  const Point between = a.middle - b.middle;
  const double distance = between.norm(), found = distance - a.radius - b.radius;
  if (found >= enough || !(distance > enough)) return found;
  // Then the room between two planes across.
  const SheetBlocks::Level& level = sheet_->levels()[l];
  const Point axis = between / distance;
  double low = unlimited, high = -unlimited;
  for (const int i : level.vertices_of(pair.first)) low = std::min(low, axis.dot(place(i) - b.middle));
  for (const int i : level.vertices_of(pair.second)) high = std::max(high, axis.dot(place(i) - b.middle));
  return std::max(found, low - high);
}

const SmoothSheet::Ball& SmoothSheet::ball(Index l, Index block) {
  Ball& ball = levels_[l].balls[block];
  if (ball.seen == calls_) return ball;
  ball.seen = calls_;
  const auto vertices = sheet_->levels()[l].vertices_of(block);
  if (vertices.empty()) return ball;
  Point low = Point::Constant(unlimited), high = -low, slow = low, fast = high;
  for (const int i : vertices) {
    low = low.cwiseMin(place(i));
    high = high.cwiseMax(place(i));
    slow = slow.cwiseMin(way(i));
    fast = fast.cwiseMax(way(i));
  }
  ball.middle = (low + high) / 2;
  ball.way = (slow + fast) / 2;
  ball.spread = (fast - slow).norm() / 2;
  double widest = 0;
  for (const int i : vertices) widest = std::max(widest, (place(i) - ball.middle).squaredNorm());
  ball.radius = std::sqrt(widest);
  return ball;
}

void SmoothSheet::gather(Index l, const Part& part, FeatureSet& features) const {
  features.clear();
  sheet_->levels()[l].all_pieces(part, [&](Index p) {
    if (sheet_->is_cloth(p)) features.triangles.push_back(sheet_->pieces()[p].vertices);
    return true;
  });
  features.complete();
}

bool SmoothSheet::features_are_apart(const FeatureSet& a, const FeatureSet& b) {
  return all_pairs(a, b, [&](Feature feature, const std::array<int, 4>& vertices) {
    if (allowance_-- <= 0) return false;
    FourPoints p, move;
    for (Index k = 0; k < 4; ++k) {
      p[k] = place(vertices[k]);
      move[k] = way(vertices[k]);
    }
    const double distance = std::sqrt(nearest(feature, p).squared), change = largest_change(feature, move);
    return change <= distance - distance_ && change <= most_moved * distance;
  });
}

}  // namespace drape
