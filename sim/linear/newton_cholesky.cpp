#include "sim/linear/newton_cholesky.hpp"

#include <algorithm>

#include "drape/core/error.hpp"
#include "sim/kernels/kernels.hpp"
#include "sim/linear/multifrontal_cholesky.hpp"

namespace drape {
namespace {

// Initial shift of an indefinite matrix due to rounding, as a fraction of the largest diagonal entry.
constexpr double first_shift = 1e-14;
// Smallest fraction of the negative eigenvalues to try.
constexpr double least_concavity = 1.0 / 64;

using Index = std::size_t;

/// Returns the pattern with every entry replaced by a 3×3 block; on the diagonal by its lower triangle.
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

/// Returns an order of 3×3 blocks as one of scalar rows.
std::vector<int> expanded(const std::vector<int>& order) {
  std::vector<int> result;
  for (const int block : order) {
    for (int axis = 0; axis < 3; ++axis) result.push_back(3 * block + axis);
  }
  return result;
}

Eigen::Matrix3d spring_hessian(const Spring& spring, const Vertices& x, double concavity) {
  const Eigen::Vector3d d = (x.row(spring.i) - x.row(spring.j)).transpose();
  const double length = d.norm();
  if (!(length > 0)) return Eigen::Matrix3d::Zero();
  const Eigen::Vector3d u = d / length;
  const Eigen::Matrix3d along = u * u.transpose();
  const double across = 1 - share_across(spring.rest_length / length, concavity);
  return spring.stiffness * (along + across * (Eigen::Matrix3d::Identity() - along));
}

}  // namespace

NewtonCholesky::NewtonCholesky(const System& system, const StepObjective& objective)
    : system_(system), objective_(objective) {
  const FreeVertices free(system.cloth);
  const int n = free.count();
  if (n == 0) return;

  for (int row = 0; row < n; ++row) {
    vertices_.push_back(free.vertex(row));
    inertia_.push_back(objective.inertia()[vertices_.back()]);
  }
  for (int i = 0; i < system.cloth.vertex_count(); ++i) numbers_.push_back(free.number(i));
  for (const auto& energy : system.energies) hessians_.push_back(energy->make_hessian());
  plain_ = spring_pattern(system.stiffness_bound(), free);
  lay_out_plainly();
}

void NewtonCholesky::lay_out_plainly() {
  lay_out(plain_, dissect(plain_, FreeVertices(system_.cloth).rest_places(system_.cloth)));
}

void NewtonCholesky::lay_out(LowerPattern blocks, const std::vector<int>& order) {
  pattern_ = std::move(blocks);
  places_.clear();
  system_.stiffness_bound().for_each_pair([&](const Spring& spring) {
    const auto [low, high] = std::minmax(numbers_[Index(spring.i)], numbers_[Index(spring.j)]);
    places_.push_back({low, high, low < 0 ? 0 : rank_of(low, high)});
  });
  const LowerPattern pattern = expanded(pattern_);
  column_starts_.assign(pattern.starts.begin(), pattern.starts.end() - 1);
  values_.resize(Index(pattern.entries()));
  right_hand_side_.resize(3 * vertices_.size());
  factor_.emplace(pattern, expanded(order), Solves::few);
}

int NewtonCholesky::rank_of(int low, int high) const {
  const auto begin = pattern_.rows.begin() + pattern_.starts[Index(low)];
  const auto end = pattern_.rows.begin() + pattern_.starts[Index(low) + 1];
  const auto at = std::lower_bound(begin, end, high);
  return at != end && *at == high ? static_cast<int>(at - begin) - 1 : -1;
}

template <class Visit>
void NewtonCholesky::for_each_pair(const ContactBlock& block, const Visit& visit) const {
  for (Index a = 0; a < Index(block.count); ++a) {
    for (Index b = 0; b < a; ++b) {
      const auto [low, high] = std::minmax(numbers_[Index(block.vertices[a])], numbers_[Index(block.vertices[b])]);
      if (low >= 0) visit(low, high);
    }
  }
}

bool NewtonCholesky::couples(const ContactBlock& block) const {
  bool all = true;
  for_each_pair(block, [&](int low, int high) { all = all && rank_of(low, high) >= 0; });
  return all;
}

namespace {

/// Returns a pattern with more rows in its columns, which may have some of them already.
LowerPattern widened(const LowerPattern& pattern, std::vector<std::vector<int>> more) {
  LowerPattern result;
  result.starts.push_back(0);
  for (Index c = 0; c < more.size(); ++c) {
    std::vector<int>& rows = more[c];
    rows.insert(rows.end(), pattern.rows.begin() + pattern.starts[c], pattern.rows.begin() + pattern.starts[c + 1]);
    std::ranges::sort(rows);
    rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
    result.rows.insert(result.rows.end(), rows.begin(), rows.end());
    result.starts.push_back(static_cast<int>(result.rows.size()));
  }
  return result;
}

}  // namespace

bool NewtonCholesky::set_contacts(std::vector<ContactBlock> contacts) {
  contacts_ = std::move(contacts);
  if (vertices_.empty() || widen_pattern()) return true;
  contacts_.clear();
  return false;
}

bool NewtonCholesky::widen_pattern() {
  const bool forgets = std::exchange(forgets_, false);
  if (forgets) too_wide_ = false;
  const bool coupled = std::ranges::all_of(contacts_, [&](const ContactBlock& block) { return couples(block); });
  if (too_wide_ || (coupled && !forgets)) return !too_wide_;
  std::vector<std::vector<int>> more(vertices_.size());
  for (const ContactBlock& block : contacts_) {
    for_each_pair(block, [&](int low, int high) { more[Index(low)].push_back(high); });
  }
  LowerPattern pattern = widened(forgets ? plain_ : pattern_, std::move(more));
  if (pattern == pattern_) return true;
  if (pattern == plain_) {
    lay_out_plainly();
    return true;
  }
  try {
    // Contacts join vertices far apart on the cloth, so CHOLMOD orders them.
    const std::vector<int> order = find_supernodes(pattern, {}).order;
    lay_out(std::move(pattern), order);
  } catch (const UsageError&) {
    lay_out_plainly();
    too_wide_ = true;
  }
  return !too_wide_;
}

void NewtonCholesky::add_contacts() {
  for (const ContactBlock& block : contacts_) {
    if (block.stiffness.isZero(0)) continue;  // only a place in the pattern
    for (Index a = 0; a < Index(block.count); ++a) {
      const int i = numbers_[Index(block.vertices[a])];
      if (i < 0) continue;
      add_diagonal(i, block.weights[a] * block.weights[a] * block.stiffness);
      for (Index b = 0; b < a; ++b) {
        const int j = numbers_[Index(block.vertices[b])];
        if (j < 0) continue;
        add_below(std::min(i, j), rank_of(std::min(i, j), std::max(i, j)),
                  block.weights[a] * block.weights[b] * block.stiffness);
      }
    }
  }
}

void NewtonCholesky::add(const Place& place, const Eigen::Matrix3d& block) {
  if (place.high >= 0) add_diagonal(place.high, block);
  if (place.low < 0) return;
  add_diagonal(place.low, block);
  add_below(place.low, place.rank, -block);
}

void NewtonCholesky::add_pair(const Place& place, const Eigen::Matrix3d& block) {
  const Eigen::Matrix3d own = (block + block.transpose()) / 2;
  if (place.high >= 0) add_diagonal(place.high, own);
  if (place.low < 0) return;
  add_diagonal(place.low, own);
  add_below(place.low, place.rank, -block.transpose());  // rows have the order of the vertices
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

void NewtonCholesky::assemble(const Vertices& x, double concavity) {
  std::fill(values_.begin(), values_.end(), 0.0);
  for (Index row = 0; row < inertia_.size(); ++row) {
    const double damping = damping_.size() == 0 ? 0 : damping_[vertices_[row]];
    add_diagonal(static_cast<int>(row), (inertia_[row] + damping) * Eigen::Matrix3d::Identity());
  }
  for (Index s = 0; s < system_.springs.size(); ++s) {
    if (places_[s].high >= 0) add(places_[s], spring_hessian(system_.springs[s], x, concavity));
  }
  add_energies(x, concavity);
  add_contacts();
}

bool NewtonCholesky::factorize(const Vertices& x, double most) {
  for (double share = std::min(most, concavity_); share >= least_concavity; share /= 4) {
    assemble(x, share);
    if (factor_->factorize(values_.data(), [this] { system_.stop.check(); })) {
      concavity_ = 4 * share;
      return true;
    }
    concavity_ = share;
  }
  assemble(x, 0);
  return factorize_positive();
}

bool NewtonCholesky::factorize_positive() {
  // The matrix is positive definite in exact arithmetic; a multiple of the identity compensates rounding (Nocedal and
  // Wright 2006, algorithm 3.3).
  double largest = 0;
  for (const int start : column_starts_) largest = std::max(largest, values_[Index(start)]);
  const auto check_stop = [this] { system_.stop.check(); };
  for (double shift = first_shift * largest; !factor_->factorize(values_.data(), check_stop); shift *= 10) {
    if (!(shift <= largest)) return false;
    for (const int start : column_starts_) values_[Index(start)] += shift;
  }
  return true;
}

void NewtonCholesky::add_energies(const Vertices& x, double concavity) {
  if (hessians_.empty()) return;
  blocks_.pairs.clear();
  blocks_.products.clear();
  blocks_.vertices.setZero(x.rows(), 6);
  for (const auto& hessian : hessians_) {
    hessian->linearise(x, objective_.time(), concavity);
    hessian->add_blocks(blocks_);
  }
  const Place* place = places_.data() + system_.springs.size();
  for (const Eigen::Matrix3d& block : blocks_.pairs) add_pair(*place++, block);
  for (Index row = 0; row < vertices_.size(); ++row) {
    const auto b = blocks_.vertices.row(vertices_[row]);
    Eigen::Matrix3d block;
    block << b[0], b[1], b[2], b[1], b[3], b[4], b[2], b[4], b[5];
    add_diagonal(static_cast<int>(row), block);
  }
}

void NewtonCholesky::solve(const Vertices& x, const Vertices& gradient, double concavity, Vertices& direction) {
  direction.setZero();
  if (!factor_ || !factorize(x, concavity)) return;
  solve_products();
  solve_factored(gradient, direction);
}

void NewtonCholesky::solve_products() {
  updates_.resize(blocks_.products.size());
  for (Index p = 0; p < updates_.size(); ++p) {
    const HessianProduct& product = blocks_.products[p];
    std::fill(right_hand_side_.begin(), right_hand_side_.end(), 0.0);
    for (Index i = 0; i < product.vertices.size(); ++i) {
      const int row = numbers_[Index(product.vertices[i])];
      if (row < 0) continue;
      for (int axis = 0; axis < 3; ++axis) right_hand_side_[3 * Index(row) + Index(axis)] = product.direction[i][axis];
    }
    factor_->solve(right_hand_side_.data(), right_hand_side_.data());
    correct_for_products(p);
    updates_[p].solution = right_hand_side_;
    updates_[p].scale = product.stiffness / (1 + product.stiffness * along(product));
  }
}

double NewtonCholesky::along(const HessianProduct& product) const {
  double sum = 0;
  for (Index i = 0; i < product.vertices.size(); ++i) {
    const int row = numbers_[Index(product.vertices[i])];
    if (row >= 0)
      sum += product.direction[i].dot(Eigen::Map<const Eigen::RowVector3d>(&right_hand_side_[3 * Index(row)]));
  }
  return sum;
}

void NewtonCholesky::correct_for_products(Index count) {
  for (Index p = 0; p < count; ++p) {
    const double by = updates_[p].scale * along(blocks_.products[p]);
    for (Index i = 0; i < right_hand_side_.size(); ++i) right_hand_side_[i] -= by * updates_[p].solution[i];
  }
}

void NewtonCholesky::solve_factored(const Vertices& gradient, Vertices& direction) {
  direction.setZero();
  for (Index row = 0; row < vertices_.size(); ++row) {
    for (int axis = 0; axis < 3; ++axis) right_hand_side_[3 * row + Index(axis)] = gradient(vertices_[row], axis);
  }
  factor_->solve(right_hand_side_.data(), right_hand_side_.data());
  correct_for_products(updates_.size());
  for (Index row = 0; row < vertices_.size(); ++row) {
    for (int axis = 0; axis < 3; ++axis) direction(vertices_[row], axis) = right_hand_side_[3 * row + Index(axis)];
  }
}

CheaperNewton::CheaperNewton(const System& system, const StepObjective& objective)
    : system_(system), objective_(objective), iterated_(system, objective), patience_(iterated_.worth_a_factor()) {}

void CheaperNewton::begin() {
  factors_ = false;
  if (factored_) factored_->begin();
}

void CheaperNewton::solve(const Vertices& x, const Vertices& gradient, double concavity, Vertices& direction) {
  if (!factors_ && iterated_.solve_within(patience_, x, gradient, concavity, direction)) return;
  factors_ = make_factor();
  if (factors_) {
    factored_->solve(x, gradient, concavity, direction);
  } else {
    iterated_.solve(x, gradient, concavity, direction);
  }
}

bool CheaperNewton::make_factor() {
  if (factored_ || refused_) return factored_ != nullptr;
  try {
    factored_ = std::make_unique<NewtonCholesky>(system_, objective_);
  } catch (const UsageError&) {
    refused_ = true;
    patience_ = ConjugateGradients::most_iterations;
  }
  return factored_ != nullptr;
}

}  // namespace drape
