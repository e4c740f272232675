#include "sim/dashpots.hpp"

#include <algorithm>
#include <utility>

#include "sim/bending/bending_energy.hpp"

namespace drape {
namespace {

constexpr double rest_length_of_dashpots = 1e200;  // [m]

std::vector<Spring> dashpots_along(std::span<const Spring> springs, double time) {
  std::vector<Spring> result(springs.begin(), springs.end());
  for (Spring& s : result) {
    s.stiffness *= time;
    s.rest_length = rest_length_of_dashpots;
  }
  return result;
}

}  // namespace

SpringDashpots::SpringDashpots(std::span<const Spring> springs, double time, int vertex_count, const Threads& threads)
    : network_(dashpots_along(springs, time), vertex_count, threads) {
  network_.compute_blocks(Vertices::Zero(vertex_count, 3), 0, blocks_);
  directions_at_ = Vertices::Zero(vertex_count, 3);
}

void SpringDashpots::set_directions(const Vertices& x) {
  directions_at_ = x;
  network_.compute_blocks(x, 0, blocks_);
}

void SpringDashpots::add_product(const Vertices& v, Vertices& product) const {
  network_.add_product(blocks_, v, product);
}

void SpringDashpots::add_blocks(double factor, HessianBlocks& blocks) const {
  for (const Spring& s : network_.springs()) {
    const Eigen::RowVector3d d = directions_at_.row(s.i) - directions_at_.row(s.j);
    const double square = d.squaredNorm();
    const double scale = square > 0 ? factor * s.stiffness / square : 0;
    blocks.pairs.emplace_back(scale * d.transpose() * d);
  }
}

void SpringDashpots::add_bound(double factor, StiffnessBound& bound) const {
  for (const Spring& s : network_.springs()) {
    bound.pairs.push_back({.i = s.i, .j = s.j, .rest_length = 0, .stiffness = factor * s.stiffness});
  }
}

BendingDashpots::BendingDashpots(std::span<const CurvatureElement> elements, double time)
    : time_(time), pairs_(curvature_pairs(elements)) {
  for (const CurvatureElement& e : elements) {
    for (Eigen::Index row = 0; row < e.weights.rows(); ++row) {
      const std::size_t first = terms_.size();
      for (std::size_t c = 0; c < e.vertices.size(); ++c) {
        const double weight = e.weights(row, static_cast<Eigen::Index>(c));
        if (weight != 0) terms_.push_back({e.vertices[c], weight});
      }
      if (terms_.size() > first) components_.push_back({.first = first, .last = terms_.size()});
    }
  }
}

Eigen::RowVector3d BendingDashpots::rate(const Component& component, const Vertices& v) const {
  Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
  const Eigen::RowVector3d origin = v.row(terms_[component.first].vertex);
  for (const auto& [vertex, weight] : terms(component)) sum += weight * (v.row(vertex) - origin);
  return sum;
}

void BendingDashpots::set_directions(const Vertices& x) {
  for (Component& component : components_) {
    const Eigen::RowVector3d q = rate(component, x);
    const double length = q.norm();
    component.direction.setZero();
    if (length > 0) component.direction = q / length;
  }
}

void BendingDashpots::add_product(const Vertices& v, Vertices& product) const {
  for (const Component& component : components_) {
    Eigen::RowVector3d force = rate(component, v);
    const Eigen::RowVector3d& n = component.direction;
    if (!n.isZero(0)) force = n.dot(force) * n;
    force *= time_;
    for (const auto& [vertex, weight] : terms(component)) product.row(vertex) += weight * force;
  }
}

void BendingDashpots::add_blocks(double factor, HessianBlocks& blocks) const {
  const std::size_t begin = blocks.pairs.size();
  blocks.pairs.resize(begin + pairs_.size(), Eigen::Matrix3d::Zero());
  const auto block_of = [&](const Term& a, const Term& b) -> Eigen::Matrix3d& {
    const auto pair = std::minmax({a.vertex, b.vertex});
    const auto place = std::lower_bound(pairs_.begin(), pairs_.end(), pair,
                                        [](const Spring& s, const auto& p) { return std::pair(s.i, s.j) < p; });
    return blocks.pairs[begin + static_cast<std::size_t>(place - pairs_.begin())];
  };
  for (const Component& component : components_) {
    const Eigen::RowVector3d& n = component.direction;
    Eigen::Matrix3d along = Eigen::Matrix3d::Identity();
    if (!n.isZero(0)) along = n.transpose() * n;
    const auto all = terms(component);
    for (auto a = all.begin(); a != all.end(); ++a) {
      for (auto b = a + 1; b != all.end(); ++b) block_of(*a, *b) -= factor * time_ * a->weight * b->weight * along;
    }
  }
}

void BendingDashpots::add_bound(double factor, StiffnessBound& bound) const {
  for (Spring pair : pairs_) {
    pair.stiffness *= factor * time_;
    bound.pairs.push_back(pair);
  }
}

}  // namespace drape
