#include "sim/bending/bending_energy.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "sim/concavity.hpp"

namespace drape {
namespace {

/// The pairs of vertices that the elements couple, sorted, each once.
std::vector<Spring> couplings(std::span<const CurvatureElement> elements) {
  std::vector<Spring> all;
  for (const CurvatureElement& e : elements) {
    for (int c = 0; c < e.count; ++c) {
      for (int d = c + 1; d < e.count; ++d) {
        const auto [i, j] =
            std::minmax({e.vertices[static_cast<std::size_t>(c)], e.vertices[static_cast<std::size_t>(d)]});
        const double stiffness = -e.weights.col(c).dot(e.weights.col(d));
        if (i != j) all.push_back({.i = i, .j = j, .rest_length = 0, .stiffness = stiffness});
      }
    }
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const Spring& a, const Spring& b) { return std::tie(a.i, a.j) < std::tie(b.i, b.j); });
  std::vector<Spring> pairs;
  for (const Spring& s : all) {
    if (!pairs.empty() && pairs.back().i == s.i && pairs.back().j == s.j) {
      pairs.back().stiffness += s.stiffness;
    } else {
      pairs.push_back(s);
    }
  }
  return pairs;
}

}  // namespace

/// H of the quadratic part, which is constant, and −s(I − q̂q̂ᵀ) wwᵀ of every curved component, s = share_across(r/‖q‖,
/// concavity): the exact Hessian where ‖q‖ > r, else a part of it, as with springs.
class BendingHessian final : public EnergyHessian {
 public:
  explicit BendingHessian(const BendingEnergy& energy) : energy_(energy), curved_(energy.curved_.size()) {
    const std::vector<Spring>& pairs = energy.pairs();
    for (const auto& component : energy.curved_) {
      for (std::size_t c = 0; c < 6; ++c) {
        for (std::size_t d = c + 1; d < 6; ++d) {
          const auto [i, j] = std::minmax({component.vertices[c], component.vertices[d]});
          const auto place = std::lower_bound(pairs.begin(), pairs.end(), std::pair{i, j}, [](const Spring& s, auto p) {
            return std::pair{s.i, s.j} < p;
          });
          places_.push_back(i == j ? -1 : static_cast<int>(place - pairs.begin()));
        }
      }
    }
  }

  void linearise(const Vertices& x, double, double concavity) override {
    for (std::size_t k = 0; k < curved_.size(); ++k) {
      const Eigen::Vector3d q = energy_.curved_[k].bent(x).transpose();
      const double length = q.norm();
      curved_[k].setZero();
      if (!(length > 0)) continue;
      const double share = share_across(energy_.curved_[k].rest / length, concavity);
      curved_[k] = share * (q * q.transpose() / (length * length) - Eigen::Matrix3d::Identity());
    }
  }

  void add_product(const Vertices& vector, Vertices& product) const override {
    energy_.quadratic_.add_value_gradient(vector, product);  // a linear function, as no pair has a rest length
    for (std::size_t k = 0; k < curved_.size(); ++k) {
      const auto& component = energy_.curved_[k];
      const Eigen::RowVector3d force = component.bent(vector) * curved_[k];
      for (std::size_t c = 0; c < 6; ++c) {
        product.row(component.vertices[c]) += component.weights[static_cast<Eigen::Index>(c)] * force;
      }
    }
  }

  void add_blocks(HessianBlocks& blocks) const override {
    const std::size_t first = blocks.pairs.size();
    for (const Spring& pair : energy_.pairs()) blocks.pairs.emplace_back(pair.stiffness * Eigen::Matrix3d::Identity());
    const int* place = places_.data();
    for (std::size_t k = 0; k < curved_.size(); ++k) {
      const auto& w = energy_.curved_[k].weights;
      for (int c = 0; c < 6; ++c) {
        for (int d = c + 1; d < 6; ++d, ++place) {
          if (*place >= 0) blocks.pairs[first + static_cast<std::size_t>(*place)] -= w[c] * w[d] * curved_[k];
        }
      }
    }
  }

 private:
  const BendingEnergy& energy_;
  std::vector<Eigen::Matrix3d> curved_;  // −s(I − q̂q̂ᵀ) of each curved component
  std::vector<int> places_;              // among the pairs, of the 15 of each curved component; −1 for none
};

BendingEnergy::BendingEnergy(std::span<const CurvatureElement> elements, int vertex_count, const Threads& threads)
    : quadratic_(couplings(elements), vertex_count, threads) {
  for (const CurvatureElement& e : elements) {
    for (int k = 0; k < 3; ++k) {
      if (e.rest[k] == 0) continue;
      Curved component{.vertices = e.vertices, .weights = e.weights.row(k).transpose(), .rest = e.rest[k]};
      std::fill(component.vertices.begin() + e.count, component.vertices.end(), e.vertices[0]);
      curved_.push_back(component);
    }
  }
}

Eigen::RowVector3d BendingEnergy::Curved::bent(const Vertices& x) const {
  Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
  // Differences from one vertex: as the weights sum to zero, the cloth's place does not enter.
  for (std::size_t c = 1; c < 6; ++c) {
    sum += weights[static_cast<Eigen::Index>(c)] * (x.row(vertices[c]) - x.row(vertices[0]));
  }
  return sum;
}

double BendingEnergy::add_gradient(const Vertices& x, double, Vertices& gradient) const {
  double value = quadratic_.add_value_gradient(x, gradient);
  for (const Curved& component : curved_) {
    const Eigen::RowVector3d q = component.bent(x);
    const double length = q.norm(), r = component.rest;
    value += r * (0.5 * r - length);
    if (!(length > 0)) continue;  // bent to nothing: no direction to bend back to
    const Eigen::RowVector3d force = -r / length * q;
    for (std::size_t c = 0; c < 6; ++c) {
      gradient.row(component.vertices[c]) += component.weights[static_cast<Eigen::Index>(c)] * force;
    }
  }
  return value;
}

void BendingEnergy::add_bound(StiffnessBound& bound) const {
  bound.pairs.insert(bound.pairs.end(), pairs().begin(), pairs().end());
}

std::unique_ptr<EnergyHessian> BendingEnergy::make_hessian() const { return std::make_unique<BendingHessian>(*this); }

}  // namespace drape
