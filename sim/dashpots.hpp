#pragma once

#include <span>

#include "sim/bending/curvature.hpp"
#include "sim/spring_network.hpp"
#include "sim/system.hpp"

namespace drape {

/// Dashpots with a force −C v, C = Σ c wwᵀ ⊗ n̂n̂ᵀ. Each resists the rate n̂·Σ wᵢ vᵢ at which one length of the cloth
/// changes, with the coefficient c. The length is ‖q‖, q = Σ wᵢ xᵢ, and n̂ = q/‖q‖ at fixed positions. As Σ wᵢ = 0 and
/// n̂ ∥ q, the forces have neither a sum nor a torque at these positions. C is positive semi-definite, so no energy is
/// gained.
struct Dashpots {
  virtual ~Dashpots() = default;
  /// Sets the directions to those at positions x, n×3 [m].
  virtual void set_directions(const Vertices& x) = 0;
  /// Adds C·v to the product, both n×3 [N] for v in [m/s].
  virtual void add_product(const Vertices& v, Vertices& product) const = 0;
  /// Appends the blocks of factor·C, in the order of add_bound().
  virtual void add_blocks(double factor, HessianBlocks& blocks) const = 0;
  /// Appends pairs that bound factor·C in all directions.
  virtual void add_bound(double factor, StiffnessBound& bound) const = 0;
};

/// A dashpot along every spring, with c = τ k.
class SpringDashpots final : public Dashpots {
 public:
  /// @param time τ [s]
  SpringDashpots(std::span<const Spring> springs, double time, int vertex_count, const Threads& threads);

  void set_directions(const Vertices& x) override;
  void add_product(const Vertices& v, Vertices& product) const override;
  void add_blocks(double factor, HessianBlocks& blocks) const override;
  void add_bound(double factor, StiffnessBound& bound) const override;

 private:
  // Springs of stiffness c so short that their Hessian without its negative part is C.
  SpringNetwork network_;
  SpringNetwork::Blocks blocks_;
  Vertices directions_at_;
};

/// A dashpot on each component of a cloth's curvature, with c = τ: it resists the change of ‖q‖ in ½(‖q‖ − r)². A
/// straight component, q = 0, has no direction, and its dashpot resists all of them.
class BendingDashpots final : public Dashpots {
 public:
  /// @param time τ [s]
  BendingDashpots(std::span<const CurvatureElement> elements, double time);

  void set_directions(const Vertices& x) override;
  void add_product(const Vertices& v, Vertices& product) const override;
  void add_blocks(double factor, HessianBlocks& blocks) const override;
  void add_bound(double factor, StiffnessBound& bound) const override;

 private:
  struct Term {
    int vertex;
    double weight;  // w
  };
  struct Component {
    std::size_t first, last;                                    // of its terms, the last exclusive
    Eigen::RowVector3d direction = Eigen::RowVector3d::Zero();  // n̂; zero for a straight one
  };

  [[nodiscard]] std::span<const Term> terms(const Component& component) const {
    return std::span(terms_).subspan(component.first, component.last - component.first);
  }
  /// Returns Σ w v of a component, without cancellation of a common part of v.
  [[nodiscard]] Eigen::RowVector3d rate(const Component& component, const Vertices& v) const;
  double time_;                // τ [s]
  std::vector<Spring> pairs_;  // see curvature_pairs()
  std::vector<Term> terms_;
  std::vector<Component> components_;
};

}  // namespace drape
