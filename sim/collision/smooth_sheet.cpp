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
constexpr float unlimited = std::numeric_limits<float>::infinity();

double norm_of(const SheetMotion::Row& row) { return row.matrix().norm(); }

using Range = SheetBlocks::Range;

Range around(const Range& a, const Range& b) { return {std::min(a.first, b.first), std::max(a.last, b.last)}; }

}  // namespace

SmoothSheet::SmoothSheet(const Cloth& cloth, const Threads& threads) {
  auto sheet = SheetBlocks::of(cloth);
  if (!sheet) return;
  for (const SheetBlocks::Level& level : sheet->levels()) {
    LevelState state;
    state.columns = std::max<Index>(level.columns() - 1, 1);
    state.windows.resize(state.columns * std::max<Index>(level.rows() - 1, 1));
    levels_.push_back(std::move(state));
  }
  motion_.emplace(std::move(*sheet), threads);
}

bool SmoothSheet::stays_apart(const Vertices& x, double h, const Vertices& v, double distance) {
  if (!motion_ || pause_-- > 0) return false;
  // What has not been visited in the call before is looked at anew.
  calls_ += distance == distance_ ? 1 : 2;
  distance_ = distance;
  allowance_ = compared_per_vertex * static_cast<int>(x.rows());
  const bool apart = motion_->measure(x, h, v) && window_is_apart(0, 0, 0);
  failures_ = apart ? 0 : std::min(failures_ + 1, most_pause);
  pause_ = failures_;
  return apart;
}

bool SmoothSheet::window_is_apart(Index l, Index column, Index row) {
  Window& window = levels_[l].windows[row * levels_[l].columns + column];
  if (window.seen == calls_) return true;
  const bool known = window.seen + 1 == calls_;
  window.seen = calls_;
  const SheetBlocks::Level& level = motion_->sheet().levels()[l];
  const Part part = level.window(column, row);
  if (level.is_empty(part)) return true;
  const Change change = motion_->change_in(l, part);
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
  const double needed = distance_ / motion_->sheet().least_distance() + motion_->gradient_rounding();
  const double least = std::max(needed + change.next, change.next / most_moved);
  if (first && !(motion_->least_along(*axes, {*first, *first, *first, *first})[0] >= least)) return std::nullopt;
  SheetMotion::Row found = SheetMotion::Row::Constant(unlimited);
  const SheetBlocks::Level& level = motion_->sheet().levels()[l];
  for (Index row = part.rows.first; row < part.rows.last; ++row) {
    for (Index column = part.columns.first; column < part.columns.last; ++column) {
      const auto pieces = level.pieces_of(row * level.columns() + column);
      for (Index k = 0; k < pieces.size(); k += 4) {
        const auto piece = [&](Index next) { return pieces[std::min(k + next, pieces.size() - 1)]; };
        const std::array<Index, 4> four{piece(0), piece(1), piece(2), piece(3)};
        found = found.min(motion_->least_along(*axes, four));
        if ((found >= static_cast<float>(least)).all()) continue;
        Eigen::Index worst = 0;
        found.minCoeff(&worst);
        first = four[Index(worst)];
        return std::nullopt;
      }
    }
  }
  return Room{.whole = found.minCoeff(), .beyond = found.minCoeff() - needed};
}

std::optional<SmoothSheet::Axes> SmoothSheet::frame(Index l, const Part& part) const {
  const SheetBlocks::Level& level = motion_->sheet().levels()[l];
  Eigen::Matrix<double, 3, 2> mean = Eigen::Matrix<double, 3, 2>::Zero();
  for (Index row = part.rows.first; row < part.rows.last; ++row) {
    for (Index column = part.columns.first; column < part.columns.last; ++column) {
      const auto pieces = level.pieces_of(row * level.columns() + column);
      for (Index k = 0; k < pieces.size(); k += 1 + pieces.size() / most_sampled) {
        mean += motion_->gradient(pieces[k]).cast<double>();
      }
    }
  }
  // The nearest matrix with orthonormal columns: the root of a 2×2 matrix M is (M + √det M)/√(tr M + 2√det M).
  const Eigen::Matrix2d square = mean.transpose() * mean;
  const double root = std::sqrt(std::max(0.0, square.determinant()));
  if (!(root > 0)) return std::nullopt;
  const Eigen::Matrix2d sum = square + root * Eigen::Matrix2d::Identity();
  return (mean * sum.inverse() * std::sqrt(square.trace() + 2 * root)).cast<float>();
}

bool SmoothSheet::blocks_are_apart(Index l, const Part& part) {
  const Index width = part.columns.last - part.columns.first, count = width * (part.rows.last - part.rows.first);
  std::array<Index, SheetBlocks::most_inside> blocks{};
  using Numbers = SheetBlocks::Numbers;
  std::array<Numbers, 3> low, high;
  for (Index axis = 0; axis < 3; ++axis) {
    low[axis].setConstant(unlimited);
    high[axis].setConstant(-unlimited);
  }
  Numbers reach = Numbers::Zero();
  Row together = Row::Zero();  // what they all do brings nothing together
  for (Index k = 0; k < count; ++k) {
    blocks[k] = (part.rows.first + k / width) * motion_->sheet().levels()[l].columns() + part.columns.first + k % width;
    const Boxes& boxes = motion_->boxes(l, blocks[k]);
    for (Index axis = 0; axis < 3; ++axis) {
      low[axis][Eigen::Index(k)] = boxes.low[Eigen::Index(axis)];
      high[axis][Eigen::Index(k)] = boxes.high[Eigen::Index(axis)];
    }
    together += boxes.way();
  }
  together /= static_cast<float>(count);
  for (Index k = 0; k < count; ++k) {
    const Boxes& boxes = motion_->boxes(l, blocks[k]);
    const double moves = norm_of(boxes.way() - together) + boxes.spread();
    reach[Eigen::Index(k)] = static_cast<float>(distance_ / 2 + motion_->rounding() + moves / most_moved);
  }
  const SheetBlocks::Pairs& near = SheetBlocks::pairs_apart(width);
  for (Index k = 0; k + 1 < count; ++k) {
    const auto at = Eigen::Index(k);
    Numbers squared = near[k];
    for (Index axis = 0; axis < 3; ++axis) {
      squared += (low[axis] - high[axis][at]).max(low[axis][at] - high[axis]).max(0).square();
    }
    if ((squared - (reach + reach[at]).square()).minCoeff() > 0) continue;
    for (Index m = k + 1; m < count; ++m) {
      if (near[k][Eigen::Index(m)] == 0 && !pair_is_apart(l, {blocks[k], blocks[m]})) return false;
    }
  }
  return true;
}

bool SmoothSheet::pair_is_apart(Index l, const Pair& pair) {
  const SheetBlocks::Level& level = motion_->sheet().levels()[l];
  const auto& [first, second] = pair;
  const Part a = level.part_of(first), b = level.part_of(second);
  if (level.is_empty(a) || level.is_empty(b)) return true;
  const Part between{.columns = around(a.columns, b.columns), .rows = around(a.rows, b.rows)};
  const Boxes &at = motion_->boxes(l, first), &other = motion_->boxes(l, second);
  const double moved = norm_of(at.way() - other.way()) + at.spread() + other.spread();
  const double enough = std::max(distance_ + moved, moved / most_moved) + motion_->rounding();
  if (gap(l, pair, enough) >= enough) return true;
  if (l + 1 == levels_.size()) {
    std::optional<Index> unused;
    if (smooth(l, between, motion_->change_in(l, between), unused)) return true;
    gather(l, a, features_[0]);
    gather(l, b, features_[1]);
    return features_are_apart(features_[0], features_[1]);
  }
  const Part inner = level.inside(a), others = level.inside(b);
  const Index width = motion_->sheet().levels()[l + 1].columns();
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
  const Boxes &a = motion_->boxes(l, pair.first), &b = motion_->boxes(l, pair.second);
  const double found = norm_of((a.low - b.high).max(b.low - a.high).max(0));
  const Row between = a.middle() - b.middle();
  const double distance = norm_of(between);
  if (found >= enough || !(distance > enough)) return found;
  // Then the room between two planes across.
  const SheetBlocks::Level& level = motion_->sheet().levels()[l];
  const Row axis = between / static_cast<float>(distance);
  float low = unlimited, high = -unlimited;
  for (const int i : level.vertices_of(pair.first)) low = std::min(low, (axis * motion_->place(i)).sum());
  for (const int i : level.vertices_of(pair.second)) high = std::max(high, (axis * motion_->place(i)).sum());
  return std::max(found, static_cast<double>(low - high));
}

void SmoothSheet::gather(Index l, const Part& part, FeatureSet& features) const {
  features.clear();
  motion_->sheet().levels()[l].all_pieces(part, [&](Index p) {
    if (motion_->sheet().is_cloth(p)) features.triangles.push_back(motion_->sheet().pieces()[p].vertices);
    return true;
  });
  features.complete();
}

bool SmoothSheet::features_are_apart(const FeatureSet& a, const FeatureSet& b) {
  return all_pairs(a, b, [&](Feature feature, const std::array<int, 4>& vertices) {
    if (allowance_-- <= 0) return false;
    FourPoints p, move;
    for (Index k = 0; k < 4; ++k) {
      p[k] = motion_->place(vertices[k]).head<3>().cast<double>();
      move[k] = motion_->way(vertices[k]).head<3>().cast<double>();
    }
    const double distance = std::sqrt(nearest(feature, p).squared) - motion_->rounding();
    const double change = largest_change(feature, move) + motion_->rounding();
    return change <= distance - distance_ && change <= most_moved * distance;
  });
}

}  // namespace drape
