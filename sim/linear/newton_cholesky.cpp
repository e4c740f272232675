#include "sim/linear/newton_cholesky.hpp"

#include <algorithm>

namespace drape {
namespace {

// Beyond this many free vertices a supernodal factor is faster, at the price of bits that depend on the machine's BLAS.
constexpr int largest_simplicial = 2000;

// Of the largest entry of the diagonal: what is added to it where the matrix is indefinite by rounding.
constexpr double first_shift = 1e-14;

using Index = std::size_t;

/// The same graph with its vertices renumbered by `rank`.
LowerPattern permuted(const LowerPattern& pattern, const std::vector<int>& rank) {
  std::vector<std::vector<int>> columns(rank.size());
  for (int c = 0; c < pattern.size(); ++c) {
    for (int p = pattern.starts[Index(c)]; p < pattern.starts[Index(c) + 1]; ++p) {
      const auto [low, high] = std::minmax({rank[Index(c)], rank[Index(pattern.rows[Index(p)])]});
      columns[Index(low)].push_back(high);
    }
  }
  LowerPattern result;
  result.starts.push_back(0);
  for (auto& column : columns) {
    std::sort(column.begin(), column.end());
    result.rows.insert(result.rows.end(), column.begin(), column.end());
    result.starts.push_back(static_cast<int>(result.rows.size()));
  }
  return result;
}

/// Every entry replaced by a 3×3 block, those of the diagonal by their lower triangle.
LowerPattern expanded(const LowerPattern& blocks) {
  LowerPattern result;
  result.starts.push_back(0);
  for (int c = 0; c < blocks.size(); ++c) {
    for (int axis = 0; axis < 3; ++axis) {
      for (int row = axis; row < 3; ++row) result.rows.push_back(3 * c + row);
      for (int p = blocks.starts[Index(c)] + 1; p < blocks.starts[Index(c) + 1]; ++p) {
        for (int row = 0; row < 3; ++row) result.rows.push_back(3 * blocks.rows[Index(p)] + row);
      }
      result.starts.push_back(static_cast<int>(result.rows.size()));
    }
  }
  return result;
}

Eigen::Matrix3d spring_hessian(const Spring& spring, const Vertices& x) {
  const Eigen::Vector3d d = (x.row(spring.i) - x.row(spring.j)).transpose();
  const double length = d.norm();
  if (!(length > 0)) return Eigen::Matrix3d::Zero();
  const Eigen::Vector3d u = d / length;
  const Eigen::Matrix3d along = u * u.transpose();
  const double across = std::max(0.0, 1 - spring.rest_length / length);
  return spring.stiffness * (along + across * (Eigen::Matrix3d::Identity() - along));
}

}  // namespace

NewtonCholesky::NewtonCholesky(const System& system, const StepObjective& objective)
    : system_(system), objective_(objective) {
  const FreeVertices free(system.cloth);
  const int n = free.count();
  if (n == 0) return;

  // A fill-reducing order of the vertices is one of their 3×3 blocks too, found nine times faster.
  const std::vector<Spring> springs = system.stiffness_bound().pairs;
  const LowerPattern graph = spring_pattern(springs, free);
  const SparseCholesky analysis(graph, FactorKind::simplicial, false);
  auto rank = std::vector<int>(static_cast<Index>(n));
  for (int row = 0; row < n; ++row) {
    const int number = analysis.permutation()[row];
    rank[Index(number)] = row;
    vertices_.push_back(free.vertex(number));
    inertia_.push_back(objective.inertia()[vertices_.back()]);
  }

  const LowerPattern blocks = permuted(graph, rank);
  for (const Spring& spring : springs) {
    const int i = free.number(spring.i), j = free.number(spring.j);
    const auto [low, high] = std::minmax({i < 0 ? -1 : rank[Index(i)], j < 0 ? -1 : rank[Index(j)]});
    places_.push_back({low, high, 0});
    if (low < 0) continue;
    const auto begin = blocks.rows.begin() + blocks.starts[Index(low)];
    const auto end = blocks.rows.begin() + blocks.starts[Index(low) + 1];
    places_.back().rank = static_cast<int>(std::lower_bound(begin, end, high) - begin) - 1;
  }
  for (const auto& energy : system.energies) hessians_.push_back(energy->make_hessian());

  const LowerPattern pattern = expanded(blocks);
  column_starts_.assign(pattern.starts.begin(), pattern.starts.end() - 1);
  values_.resize(Index(pattern.entries()));
  right_hand_side_.resize(3 * Index(n));
  factor_.emplace_back(pattern, n <= largest_simplicial ? FactorKind::simplicial : FactorKind::supernodal, true);
}

void NewtonCholesky::add(const Place& place, const Eigen::Matrix3d& block) {
  if (place.high >= 0) add_diagonal(place.high, block);
  if (place.low < 0) return;
  add_diagonal(place.low, block);
  add_below(place.low, place.rank, -block);
}

void NewtonCholesky::add_diagonal(int row, const Eigen::Matrix3d& block) {
  for (int axis = 0; axis < 3; ++axis) {
    double* column = values_.data() + column_starts_[3 * Index(row) + Index(axis)];
    for (int below = axis; below < 3; ++below) column[below - axis] += block(below, axis);
  }
}

void NewtonCholesky::add_below(int column_block, int rank, const Eigen::Matrix3d& block) {
  for (int axis = 0; axis < 3; ++axis) {
    double* column =
        values_.data() + column_starts_[3 * Index(column_block) + Index(axis)] + (3 - axis) + 3 * Index(rank);
    for (int row = 0; row < 3; ++row) column[row] += block(row, axis);
  }
}

bool NewtonCholesky::factorize(const Vertices& x) {
  std::fill(values_.begin(), values_.end(), 0.0);
  for (Index row = 0; row < inertia_.size(); ++row) {
    add_diagonal(static_cast<int>(row), inertia_[row] * Eigen::Matrix3d::Identity());
  }
  for (Index s = 0; s < system_.springs.size(); ++s) {
    if (places_[s].high >= 0) add(places_[s], spring_hessian(system_.springs[s], x));
  }
  add_energies(x);
  system_.stop.look();
  // Positive definite in exact arithmetic; what rounding has spoilt, a multiple of the identity mends (Nocedal and
  // Wright 2006, algorithm 3.3).
  double largest = 0;
  for (const int start : column_starts_) largest = std::max(largest, values_[Index(start)]);
  for (double shift = first_shift * largest; !factor_.front().factorize(values_.data()); shift *= 10) {
    system_.stop.look();
    if (!(shift <= largest)) return false;
    for (const int start : column_starts_) values_[Index(start)] += shift;
  }
  return true;
}

void NewtonCholesky::add_energies(const Vertices& x) {
  if (hessians_.empty()) return;
  blocks_.pairs.clear();
  blocks_.vertices.setZero(x.rows(), 6);
  for (const auto& hessian : hessians_) {
    hessian->linearise(x, objective_.time());
    hessian->add_blocks(blocks_);
  }
  const Place* place = places_.data() + system_.springs.size();
  for (const Eigen::Matrix3d& block : blocks_.pairs) add(*place++, block);
  for (Index row = 0; row < vertices_.size(); ++row) {
    const auto b = blocks_.vertices.row(vertices_[row]);
    Eigen::Matrix3d block;
    block << b[0], b[1], b[2], b[1], b[3], b[4], b[2], b[4], b[5];
    add_diagonal(static_cast<int>(row), block);
  }
}

void NewtonCholesky::solve(const Vertices& x, const Vertices& gradient, Vertices& direction) {
  direction.setZero();
  if (factor_.empty() || !factorize(x)) return;
  for (Index row = 0; row < vertices_.size(); ++row) {
    for (int axis = 0; axis < 3; ++axis) right_hand_side_[3 * row + Index(axis)] = gradient(vertices_[row], axis);
  }
  factor_.front().solve(right_hand_side_.data(), right_hand_side_.data());
  for (Index row = 0; row < vertices_.size(); ++row) {
    for (int axis = 0; axis < 3; ++axis) direction(vertices_[row], axis) = right_hand_side_[3 * row + Index(axis)];
  }
}

}  // namespace drape
