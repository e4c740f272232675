#pragma once

#include <cstdint>
#include <memory>
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

/// Dissipation potential of dashpots in an implicit step of τ seconds, P = 1/(2τ) (x − x₀)ᵀ C (x − x₀). Its gradient is
/// C v with v = (x − x₀)/τ. C has constant directions in the step, so P is convex and quadratic, and every solver has
/// its exact Hessian. The dashpots dissipate 2 P.
class StepDissipation final : public Energy {
 public:
  /// @param shortest least τ of any step [s], for add_bound()
  /// @param start    first x₀, n×3 [m]
  /// @param threads  for its passes; must outlive this
  StepDissipation(std::shared_ptr<Dashpots> dashpots, double shortest, const Vertices& start,
                  const Threads& threads = one_thread());

  /// Begins a step of `duration` seconds from `start`, with directions at other positions, both n×3 [m].
  void begin(const Vertices& directions_at, const Vertices& start, double duration);
  /// Returns P(x) [J].
  [[nodiscard]] double value(const Vertices& x) const;

  double add_gradient(const Vertices& x, double time, Vertices& gradient) const override;
  void add_bound(StiffnessBound& bound) const override { dashpots_->add_bound(1 / shortest_, bound); }
  [[nodiscard]] std::unique_ptr<EnergyHessian> make_hessian() const override;
  [[nodiscard]] bool stored() const override { return false; }

 private:
  class Hessian;

  /// Sets product_ = C (x − x₀)/τ and returns P.
  double evaluate(const Vertices& x) const;

  std::shared_ptr<Dashpots> dashpots_;
  const Threads& threads_;
  double shortest_, duration_;
  Vertices start_;
  mutable Vertices way_, product_;  // scratch: (x − x₀)/τ [m/s]; [N]
};

/// Effect of dashpots in an explicit step: v ← D v, where D approximates exp(−t M⁻¹C) for a duration t.
///
/// D is the polynomial a + b T_s(w₀ − w₁ t M⁻¹C) of the second-order Runge-Kutta-Chebyshev method (Sommeijer, Shampine
/// and Verwer 1998, "RKC: an explicit solver for parabolic PDEs", eqs. 2.6 to 2.8), with the fewest stages s that are
/// stable: z = t λ_max(M⁻¹C) needs s ≈ √(1.5 z + 1) products with C, where plain explicit dashpots need z/2 steps.
/// Nothing is solved, so the forces keep both momenta to rounding. Between 0 and z the polynomial lies between 0 and 1:
/// D is symmetric in the masses' inner product, and never raises the kinetic energy.
///
/// The safe step is that without dashpots, however rarely they act. Without them a linear cloth conserves
///   Q = ½ wᵀM w + ½ xᵀ(K − h²/4 K M⁻¹K) x,
/// with the velocities w in the middle of the kick at x. Q is positive definite up to the safe step, and D, applied to
/// w, lowers it. If forces depend on velocities, half of the dashpots act before the kick and half after it, in every
/// step. With x' = x + h u' and u' = √D (√D u − h M⁻¹K x) an eigenvector satisfies λ² a − λ (a + d − h²κ) + d = 0 with
/// a = x·D⁻¹x, d = x·D x, κ = x·Kx in that inner product. As a + d ≥ 2 x·x and d ≤ a, no |λ| exceeds 1 if h²κ ≤ 4 x·x.
///
/// A step that is divided into substeps has a kick of the dashpots for up to 24 of them, since stages grow with the
/// square root of the duration only. Kicks lie symmetrically in the step, so the order remains 2.
class DampingKick {
 public:
  /// @param duration t [s]
  /// @throws UsageError if too many stages are needed
  DampingKick(const System& system, double duration);

  /// Sets the directions of the dashpots to those at positions x, n×3 [m].
  void set_directions(const Vertices& x);
  /// Applies D to the velocities, n×3 [m/s]. Pins keep theirs.
  void apply(Vertices& v);
  /// Applies D in the middle of a kick that changes the velocities from `before` to v.
  void apply_within(const Vertices& before, Vertices& v);

  /// Returns the number of kicks of the dashpots in a step of so many substeps.
  static std::int64_t kicks_in(std::int64_t substeps);
  /// Returns true if the dashpots act in a substep, counted as State::step.
  static bool acts_in(std::int64_t step, std::int64_t substeps);

  /// Returns the number s of stages for z; for more than a thousand, a thousand and one.
  static int stages_for(double z);

 private:
  /// Sets to = factor·(w₀ − w₁ h M⁻¹C) from − to.
  void advance(double factor, const Vertices& from, Vertices& to);

  const System& system_;
  int stages_;
  double w0_, a_, b_;
  Eigen::VectorXd rate_;              // w₁ h/m of each vertex, 0 on pins [s/kg]
  Vertices half_kick_;                // [m/s]
  Vertices before_, last_, product_;  // T_{j−1} v, T_j v [m/s]; [N]
};

}  // namespace drape
