#include "sim/collision/sheet_motion.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <utility>

#include "sim/parallel/loops.hpp"
#include "sim/parallel/vectors.hpp"

namespace drape {
namespace {

using Index = std::size_t;
using SheetRow = SheetMotion::Row;

constexpr Index at_once = 4;  // of a register's numbers
// Of the largest number: far more than some operations in single precision lose.
constexpr double lost_in_rows = 1.0 / (1 << 19);
// What is too small for its square, and what is too large, of lengths [m] and of F.
constexpr double too_small = 1e-18, too_large = 1e15;

/// `scale` times some of these vectors in single precision, less the first of all; returns the largest number.
float round_some(const Vertices& vectors, Index begin, Index end, float scale, std::vector<SheetRow>& rows) {
  SheetRow most = SheetRow::Zero();
  for (Index first = begin; first < end; first += at_once) {
    Eigen::Matrix4f four = Eigen::Matrix4f::Zero();
    const Index present = std::min(at_once, end - first);
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      const double* from = vectors.col(axis).data();
      float* to = four.col(axis).data();
      if (present == at_once) {  // a loop of this length is one of vectors
        for (Index k = 0; k < at_once; ++k) to[k] = scale * static_cast<float>(from[first + k] - from[0]);
      } else {
        for (Index k = 0; k < present; ++k) to[k] = scale * static_cast<float>(from[first + k] - from[0]);
      }
    }
    most = most.max(four.col(0).array().abs().max(four.col(1).array().abs()).max(four.col(2).array().abs()));
    four.transposeInPlace();
    for (Index k = 0; k < present; ++k) rows[first + k] = four.col(static_cast<Eigen::Index>(k)).array();
  }
  return most.maxCoeff();
}

/// Likewise, of all.
double round_to_rows(const Threads& threads, const Vertices& vectors, double scale, std::vector<SheetRow>& rows) {
  rows.resize(static_cast<Index>(vectors.rows()), SheetRow::Zero());
  return reduce(
      threads, vectors.rows(),
      [&](Eigen::Index first, Eigen::Index count) {
        return round_some(vectors, Index(first), Index(first + count), static_cast<float>(scale), rows);
      },
      [](float a, float b) { return std::max(a, b); });
}

/// The x, y and z of four vectors.
struct ColumnsOfFour {
  SheetRow x, y, z;

  ColumnsOfFour(const SheetRow& a, const SheetRow& b, const SheetRow& c, const SheetRow& d) {
    Eigen::Matrix4f rows;
    rows << a, b, c, d;
    rows.transposeInPlace();
    x = rows.col(0);
    y = rows.col(1);
    z = rows.col(2);
  }
};

}  // namespace

SheetMotion::SheetMotion(SheetBlocks sheet, const Threads& threads) : sheet_(std::move(sheet)), threads_(threads) {
  for (const auto& [vertices, inverse] : sheet_.pieces()) {
    steepest_ = std::max(steepest_, inverse.norm());
    const Eigen::Matrix2f rounded = inverse.cast<float>();
    pieces_.push_back({vertices, {rounded(0, 0), rounded(1, 0), rounded(0, 1), rounded(1, 1)}});
  }
  for (const SheetBlocks::Level& level : sheet_.levels()) boxes_.emplace_back(level.columns() * level.rows());
  gather_edges();
}

void SheetMotion::gather_edges() {
  const Index blocks = sheet_.measured().columns() * sheet_.measured().rows();
  changes_.resize(blocks);
  for (Index block = 0; block < blocks; ++block) {
    first_edges_.push_back(edges_.size());
    Index k = 0;
    for (const auto& [i, j, weight] : sheet_.edges_of(block)) {
      steepest_ = std::max(steepest_, std::sqrt(weight));
      if (k % 4 == 0) edges_.push_back({.from = {}, .to = {}, .weights = Row::Zero()});
      edges_.back().from[k % 4] = i;
      edges_.back().to[k % 4] = j;
      edges_.back().weights[static_cast<Eigen::Index>(k % 4)] = static_cast<float>(weight);
      ++k;
    }
  }
  first_edges_.push_back(edges_.size());
}

bool SheetMotion::measure(const Vertices& x, double h, const Vertices& v) {
  const bool first = ++calls_ == 1;
  // Mostly it has gone as it was about to: then how F has changed is known.
  const auto went_there = [&](Eigen::Index begin, Eigen::Index count) {
    return std::memcmp(x.data() + begin, ends_.data() + begin, Index(count) * sizeof(double)) == 0;
  };
  const bool expected = !first && reduce(threads_, x.size(), went_there, std::logical_and<>(), numbers_worth_dividing);
  for (Change& change : changes_) change.since = expected ? change.next : 0;
  double before = 0;
  if (!first && !expected) {
    before = largest_place_;
    ways_ = places_;
  }
  largest_place_ = round_to_rows(threads_, x, 1, places_);
  if (!first && !expected) {
    for_all(threads_, x.rows(), [&](Eigen::Index i) { ways_[Index(i)] = places_[Index(i)] - ways_[Index(i)]; });
    find_changes(ways_, before + largest_place_, &Change::since);
  }
  ends_.resize(x.rows(), 3);
  sum(threads_, x, h, v, ends_);
  const double way = round_to_rows(threads_, v, h, ways_);
  find_changes(ways_, way, &Change::next);
  rounding_ = lost_in_rows * (largest_place_ + way) + too_small;
  return std::max({before, largest_place_, way}) * std::max(1.0, steepest_) < too_large;
}

void SheetMotion::find_changes(const std::vector<Row>& moves, double largest, double Change::*which) {
  const double rounding = (lost_in_rows * largest + too_small) * steepest_;
  const auto find = [&](Eigen::Index number) {
    const auto block = static_cast<Index>(number);
    Row most = Row::Zero();
    for (Index k = first_edges_[block]; k < first_edges_[block + 1]; ++k) {
      const FourEdges& edges = edges_[k];
      const auto move = [&](Index e) -> Row { return moves[Index(edges.from[e])] - moves[Index(edges.to[e])]; };
      const ColumnsOfFour d(move(0), move(1), move(2), move(3));
      most = most.max(edges.weights * (d.x * d.x + d.y * d.y + d.z * d.z));
    }
    changes_[block].*which = std::sqrt(double(most.maxCoeff())) + rounding;
  };
  for_all(for_so_many(threads_, std::ssize(moves)), std::ssize(changes_), find, 0);
}

SheetMotion::Change SheetMotion::change_in(Index l, const SheetBlocks::Part& part) const {
  const auto& [columns, rows] = sheet_.levels()[l].axes;
  const Index first = columns.measured[part.columns.first].first, last = columns.measured[part.columns.last - 1].last;
  Change most;
  for (Index row = rows.measured[part.rows.first].first; row < rows.measured[part.rows.last - 1].last; ++row) {
    for (Index column = first; column < last; ++column) {
      const Change& change = changes_[row * sheet_.measured().columns() + column];
      most = {.since = std::max(most.since, change.since), .next = std::max(most.next, change.next)};
    }
  }
  return most;
}

const SheetMotion::Boxes& SheetMotion::boxes(Index l, Index block) {
  Boxes& boxes = boxes_[l][block];
  if (boxes.seen == calls_) return boxes;
  const SheetBlocks::Level& level = sheet_.levels()[l];
  Row low = Row::Constant(std::numeric_limits<float>::infinity()), high = -low, slow = low, fast = high;
  const auto add = [&](const Boxes& inner) {
    low = low.min(inner.low);
    high = high.max(inner.high);
    slow = slow.min(inner.slow);
    fast = fast.max(inner.fast);
  };
  if (&level < &sheet_.measured()) {
    const auto [columns, rows] = level.inside(level.part_of(block));
    for (Index row = rows.first; row < rows.last; ++row) {
      for (Index column = columns.first; column < columns.last; ++column) {
        add(this->boxes(l + 1, row * sheet_.levels()[l + 1].columns() + column));
      }
    }
  } else {
    for (const int i : level.vertices_of(block)) {
      const Row &place = places_[Index(i)], &way = ways_[Index(i)];
      low = low.min(place);
      high = high.max(place);
      slow = slow.min(way);
      fast = fast.max(way);
    }
  }
  boxes = {.low = low, .high = high, .slow = slow, .fast = fast, .seen = calls_};
  return boxes;
}

SheetMotion::Row SheetMotion::least_along(const Eigen::Matrix<float, 3, 2>& axes,
                                          const std::array<Index, 4>& pieces) const {
  const auto edge = [&](Index p, Index corner) -> Row {
    const Triangle& t = pieces_[p].vertices;
    return place(t[corner]) - place(t[0]);
  };
  const auto& [p, q, r, s] = pieces;
  const ColumnsOfFour a(edge(p, 1), edge(q, 1), edge(r, 1), edge(s, 1)),
      b(edge(p, 2), edge(q, 2), edge(r, 2), edge(s, 2));
  Eigen::Matrix4f inverse;
  inverse << pieces_[p].inverse, pieces_[q].inverse, pieces_[r].inverse, pieces_[s].inverse;
  inverse.transposeInPlace();
  const auto along = [&](const ColumnsOfFour& c, Eigen::Index k) -> Row {
    return axes(0, k) * c.x + axes(1, k) * c.y + axes(2, k) * c.z;
  };
  const Row ax = along(a, 0), ay = along(a, 1), bx = along(b, 0), by = along(b, 1);
  const Row i = inverse.col(0), j = inverse.col(1), k = inverse.col(2), l = inverse.col(3);
  const Row xx = ax * i + bx * j, xy = ax * k + bx * l, yx = ay * i + by * j, yy = ay * k + by * l;
  const Row half = (xx - yy) / 2, across = (xy + yx) / 2;
  return (xx + yy) / 2 - (half * half + across * across).sqrt();
}

Eigen::Matrix<float, 3, 2> SheetMotion::gradient(Index piece) const {
  const auto& [vertices, inverse] = pieces_[piece];
  const Row a = place(vertices[1]) - place(vertices[0]), b = place(vertices[2]) - place(vertices[0]);
  Eigen::Matrix<float, 3, 2> gradient;
  gradient << (a * inverse[0] + b * inverse[1]).head<3>(), (a * inverse[2] + b * inverse[3]).head<3>();
  return gradient;
}

}  // namespace drape
