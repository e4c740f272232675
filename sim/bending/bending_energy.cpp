#include "sim/bending/bending_energy.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "sim/kernels/kernels.hpp"

namespace drape {
namespace {

// Number of pairs above which they are summed; later twice the number left, if larger.
constexpr std::size_t most_unsorted = 1 << 20;

/// Sorts pairs, and sums those of the same vertices in their original order.
void add_up(std::vector<Spring>& pairs) {
  std::stable_sort(pairs.begin(), pairs.end(),
                   [](const Spring& a, const Spring& b) { return std::tie(a.i, a.j) < std::tie(b.i, b.j); });
  std::size_t count = 0;
  for (const Spring& s : pairs) {
    if (count > 0 && pairs[count - 1].i == s.i && pairs[count - 1].j == s.j) {
      pairs[count - 1].stiffness += s.stiffness;
    } else {
      pairs[count++] = s;
    }
  }
  pairs.resize(count);
}

}  // namespace

std::vector<Spring> curvature_pairs(std::span<const CurvatureElement> elements) {
  std::vector<Spring> pairs;
  std::size_t most = most_unsorted;
  for (const CurvatureElement& e : elements) {
    for (std::size_t c = 0; c < e.vertices.size(); ++c) {
      for (std::size_t d = c + 1; d < e.vertices.size(); ++d) {
        const auto [i, j] = std::minmax({e.vertices[c], e.vertices[d]});
        const double stiffness =
            -e.weights.col(static_cast<Eigen::Index>(c)).dot(e.weights.col(static_cast<Eigen::Index>(d)));
        pairs.push_back({.i = i, .j = j, .rest_length = 0, .stiffness = stiffness});
      }
    }
    if (pairs.size() < most) continue;
    add_up(pairs);
    most = std::max(most, 2 * pairs.size());
  }
  add_up(pairs);
  return pairs;
}

/// Hessian of the constant quadratic part, plus −s(I − q̂q̂ᵀ) wwᵀ of every curved component with s =
/// share_across(r/‖q‖, concavity). It is exact for ‖q‖ > r, otherwise a part of the Hessian, as with springs.
class BendingHessian final : public EnergyHessian {
 public:
  explicit BendingHessian(const BendingEnergy& energy) : energy_(energy), curved_(energy.curved_.size()) {
    const std::vector<Spring>& pairs = energy.pairs();
    for (const auto& component : energy.curved_) {
      const auto terms = energy.terms(component);
      for (std::size_t c = 0; c < terms.size(); ++c) {
        for (std::size_t d = c + 1; d < terms.size(); ++d) {
          const auto [i, j] = std::minmax({terms[c].vertex, terms[d].vertex});
          const auto place = std::lower_bound(pairs.begin(), pairs.end(), std::pair{i, j}, [](const Spring& s, auto p) {
            return std::pair{s.i, s.j} < p;
          });
          places_.push_back(static_cast<std::size_t>(place - pairs.begin()));
        }
      }
    }
  }

  void linearise(const Vertices& x, double, double concavity) override {
    for (std::size_t k = 0; k < curved_.size(); ++k) {
      const Eigen::Vector3d q = energy_.bent(energy_.curved_[k], x).transpose();
      const double length = q.norm();
      curved_[k].setZero();
      if (!(length > 0)) continue;
      const double share = share_across(energy_.curved_[k].rest / length, concavity);
      curved_[k] = share * (q * q.transpose() / (length * length) - Eigen::Matrix3d::Identity());
    }
  }

  void add_product(const Vertices& vector, Vertices& product) const override {
    energy_.quadratic_.add_value_gradient(vector, product);  // linear in the vector, as no pair has a rest length
    for (std::size_t k = 0; k < curved_.size(); ++k) {
      const auto& component = energy_.curved_[k];
      const Eigen::RowVector3d force = energy_.bent(component, vector) * curved_[k];
      for (const auto& [vertex, weight] : energy_.terms(component)) product.row(vertex) += weight * force;
    }
  }

  void add_blocks(HessianBlocks& blocks) const override {
    const std::size_t first = blocks.pairs.size();
    for (const Spring& pair : energy_.pairs()) blocks.pairs.emplace_back(pair.stiffness * Eigen::Matrix3d::Identity());
    const std::size_t* place = places_.data();
    for (std::size_t k = 0; k < curved_.size(); ++k) {
      const auto terms = energy_.terms(energy_.curved_[k]);
      for (std::size_t c = 0; c < terms.size(); ++c) {
        for (std::size_t d = c + 1; d < terms.size(); ++d, ++place) {
          blocks.pairs[first + *place] -= terms[c].weight * terms[d].weight * curved_[k];
        }
      }
    }
  }

 private:
  const BendingEnergy& energy_;
  std::vector<Eigen::Matrix3d> curved_;  // −s(I − q̂q̂ᵀ) per curved component
  std::vector<std::size_t> places_;      // indices of the pairs of each curved component's terms
};

BendingEnergy::BendingEnergy(std::span<const CurvatureElement> elements, int vertex_count, const Threads& threads)
    : quadratic_(curvature_pairs(elements), vertex_count, threads) {
  for (const CurvatureElement& e : elements) {
    if (e.rest == 0) continue;
    curved_.push_back({.first = terms_.size(), .last = terms_.size() + e.vertices.size(), .rest = e.rest});
    for (std::size_t c = 0; c < e.vertices.size(); ++c) {
      terms_.push_back({e.vertices[c], e.weights(0, static_cast<Eigen::Index>(c))});
    }
  }
}

Eigen::RowVector3d BendingEnergy::bent(const Curved& component, const Vertices& x) const {
  Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
  // Use differences from one vertex: as the weights sum to zero, the cloth's position does not matter.
  const Eigen::RowVector3d origin = x.row(terms_[component.first].vertex);
  for (const auto& [vertex, weight] : terms(component)) sum += weight * (x.row(vertex) - origin);
  return sum;
}

double BendingEnergy::add_gradient(const Vertices& x, double, Vertices& gradient) const {
  double value = quadratic_.add_value_gradient(x, gradient);
  for (const Curved& component : curved_) {
    const Eigen::RowVector3d q = bent(component, x);
    const double length = q.norm(), r = component.rest;
    value += r * (0.5 * r - length);
    if (!(length > 0)) continue;  // zero curvature: the direction to bend back is undefined
    const Eigen::RowVector3d force = -r / length * q;
    for (const auto& [vertex, weight] : terms(component)) gradient.row(vertex) += weight * force;
  }
  return value;
}

void BendingEnergy::add_bound(StiffnessBound& bound) const {
  bound.pairs.insert(bound.pairs.end(), pairs().begin(), pairs().end());
}

std::unique_ptr<EnergyHessian> BendingEnergy::make_hessian() const { return std::make_unique<BendingHessian>(*this); }

std::vector<EdgeSide> edge_sides(const std::vector<Triangle>& triangles) {
  std::vector<EdgeSide> sides;
  sides.reserve(3 * triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const auto& [a, b, c] = triangles[t];
    if (a == b || b == c || c == a) continue;
    const auto number = static_cast<int>(t);
    sides.push_back({{std::min(a, b), std::max(a, b)}, number, c});
    sides.push_back({{std::min(b, c), std::max(b, c)}, number, a});
    sides.push_back({{std::min(c, a), std::max(c, a)}, number, b});
  }
  std::sort(sides.begin(), sides.end(), [](const EdgeSide& a, const EdgeSide& b) {
    return std::tie(a.edge, a.triangle) < std::tie(b.edge, b.triangle);
  });
  return sides;
}

std::vector<Spring> cross_springs(const Cloth& cloth, double stiffness) {
  std::vector<Edge> pairs;
  for_neighbours(edge_sides(cloth.triangles), [&](const EdgeSide& side, const EdgeSide& next) {
    pairs.push_back({std::min(side.opposite, next.opposite), std::max(side.opposite, next.opposite)});
  });
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  const std::vector<Edge> edges = unique_edges(cloth.triangles);
  std::vector<Spring> springs;
  for (const auto& [i, j] : pairs) {
    if (std::binary_search(edges.begin(), edges.end(), Edge{i, j})) continue;
    springs.push_back(
        {.i = i, .j = j, .rest_length = (cloth.rest.row(i) - cloth.rest.row(j)).norm(), .stiffness = stiffness});
  }
  return springs;
}

}  // namespace drape
