#pragma once

#include <array>
#include <memory>
#include <utility>
#include <vector>

#include "sim/effects/rebound.hpp"
#include "sim/effects/surface_contact.hpp"
#include "sim/parallel/part_lists.hpp"
#include "sim/system.hpp"

namespace drape {

/// The push as an energy, E = Σ m·stiffness/2·gap². Where impacts have a restitution, what arrives in a step is not
/// pushed in it: it is the impact that stops it.
template <class Surface>
struct PenaltyEnergy final : Energy {
  Surface surface;
  double stiffness;
  const Eigen::VectorXd& masses;
  std::shared_ptr<const StepStart> start;  // null without restitution
  const Threads& threads;

  PenaltyEnergy(Surface s, double k, const Eigen::VectorXd& m, std::shared_ptr<const StepStart> begin,
                const Threads& by)
      : surface(std::move(s)), stiffness(k), masses(m), start(std::move(begin)), threads(by) {}

  double add_gradient(const Vertices& x, double time, Vertices& gradient) const override {
    const auto now = surface.at(time);
    return sum_of(threads, x.rows(), [&](Eigen::Index first, Eigen::Index count) {
      double total = 0;
      SurfaceContact contact;
      for (Eigen::Index i = first; i < first + count; ++i) {
        if (!find_contact(now, i, x.row(i).transpose(), contact) || arrives(start, i)) continue;
        const double pressure = -masses[i] * stiffness * contact.gap;
        gradient.row(i) -= pressure * contact.normal().transpose();
        total -= 0.5 * pressure * contact.gap;
      }
      return total;
    });
  }

  void add_bound(StiffnessBound& bound) const override { bound.vertices += stiffness * masses; }
  [[nodiscard]] std::unique_ptr<EnergyHessian> make_hessian() const override;
  [[nodiscard]] bool internal() const override { return false; }
  [[nodiscard]] Eigen::Vector3d displacement(double from, double to) const override {
    return surface.displacement(from, to);
  }
};

/// Of the energy's Hessian m·stiffness·(nnᵀ + gap·∇n) the first term, which is positive; the second is negative where
/// the surface is convex.
template <class Surface>
class PenaltyHessian final : public EnergyHessian {
 public:
  explicit PenaltyHessian(const PenaltyEnergy<Surface>& energy) : energy_(energy) {
    contacts_.reserve(energy.masses.size());
  }

  void linearise(const Vertices& x, double time, double /*concavity*/) override {
    const auto now = energy_.surface.at(time);
    contacts_.fill(energy_.threads, x.rows(), [&](Eigen::Index i, std::vector<PushedVertex>& list) {
      SurfaceContact contact;
      if (!find_contact(now, i, x.row(i).transpose(), contact) || arrives(energy_.start, i)) return;
      const Eigen::Vector3d n = contact.normal();
      const double k = energy_.masses[i] * energy_.stiffness;
      list.push_back({i,
                      {k * (n[0] * n[0]), k * (n[0] * n[1]), k * (n[0] * n[2]), k * (n[1] * n[1]), k * (n[1] * n[2]),
                       k * (n[2] * n[2])}});
    });
  }

  void add_product(const Vertices& vector, Vertices& product) const override {
    contacts_.for_each(energy_.threads, [&](const PushedVertex& pushed) {
      const auto& [i, b] = pushed;
      const double x = vector(i, 0), y = vector(i, 1), z = vector(i, 2);
      product(i, 0) += b[0] * x + b[1] * y + b[2] * z;
      product(i, 1) += b[1] * x + b[3] * y + b[4] * z;
      product(i, 2) += b[2] * x + b[4] * y + b[5] * z;
    });
  }

  void add_blocks(HessianBlocks& blocks) const override {
    contacts_.for_each(energy_.threads, [&](const PushedVertex& pushed) {
      for (Eigen::Index k = 0; k < 6; ++k) {
        blocks.vertices(pushed.vertex, k) += pushed.block[static_cast<std::size_t>(k)];
      }
    });
  }

 private:
  struct PushedVertex {
    Eigen::Index vertex;
    std::array<double, 6> block;  // as in HessianBlocks
  };

  const PenaltyEnergy<Surface>& energy_;
  PartLists<PushedVertex> contacts_;
};

template <class Surface>
std::unique_ptr<EnergyHessian> PenaltyEnergy<Surface>::make_hessian() const {
  return std::make_unique<PenaltyHessian<Surface>>(*this);
}

}  // namespace drape
