#pragma once

#include <array>
#include <cstddef>
#include <memory>

#include "drape/sim/mesh.hpp"
#include "sim/linear/constant_factor.hpp"
#include "sim/linear/newton_solver.hpp"
#include "sim/solvers/minimiser.hpp"

namespace drape {

/// A minimiser whose only Hessian model is Liu13's factored matrix A.
class FactoredMinimiser : public Minimiser {
 public:
  FactoredMinimiser(const System& system, const StepObjective& objective, const IntegratorSettings& settings,
                    int default_max_iterations);
  ConstantFactor& constant_factor() override { return factor_; }

 protected:
  ConstantFactor& factor() { return factor_; }
  void find_newton_step(const Iterate& point, Vertices& direction) override;

 private:
  const System& system_;
  ConstantFactor factor_;
  std::unique_ptr<ConjugateGradients> newton_;  // created on first use
};

/// The local/global alternation of Liu, Bargteil, O'Brien and Kavan, "Fast Simulation of Mass-Spring Systems", 2013.
/// The local step is d = L·x̂ for every spring, the global step (M + h²L)x' = h²Jd + My. With A = M/h² + L both are
/// computed together as x' = x − A⁻¹∇g(x), since ∇g(x) = A x − (J d + M y/h²) at the d of the local step.
class LocalGlobal final : public FactoredMinimiser {
 public:
  LocalGlobal(const System& system, const StepObjective& objective, const IntegratorSettings& settings);

  [[nodiscard]] ImplicitHessian hessian() const override { return ImplicitHessian::constant; }

 private:
  double iterate(Iterate& point) override;
};

/// Anderson acceleration of a fixed-point iteration c = T(c) (Walker and Ni 2011), n×3. Keeps the last few differences
/// of the residuals T(c) − c in orthonormal form, together with the matching differences of c. Inner products with
/// these give the combination of least residual (for linear T this is the GCR method). If the residual grows, the
/// iteration returns to the best point.
class AndersonHistory {
 public:
  /// @param unknowns n
  explicit AndersonHistory(Eigen::Index unknowns);

  /// Resets for another iteration.
  void clear();
  /// Replaces c, given its residual, by the next iterate. Returns false if it returned to the best point.
  bool advance(const Vertices& residual, Vertices& c);

 private:
  struct Pair {
    Vertices residual, c;  // differences
  };
  static constexpr std::size_t most_pairs = 12;

  /// Stores the difference of the last two points.
  void observe(const Vertices& residual, const Vertices& c);

  std::array<Pair, most_pairs> pairs_;
  std::size_t count_ = 0, oldest_ = 0;
  Vertices last_residual_, last_c_;  // of the last point, if begun_
  Vertices best_residual_, best_c_;  // of the point with the least residual, if begun_
  double best_ = 0;                  // norm of its residual
  double length_ = 1;                // step length from the best point after a return
  bool begun_ = false;
};

}  // namespace drape
