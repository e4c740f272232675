#pragma once

#include <memory>

#include "sim/linear/conjugate_gradients.hpp"
#include "sim/linear/newton_cholesky.hpp"

namespace drape {

/// Newton's equations by conjugate gradients for as long as those take less work than a factor of H. Work is counted in
/// operations, so the choice is the same on every machine; each minimisation begins with conjugate gradients, and keeps
/// to them where the factor is refused, for want of memory or of a surface.
class CheaperNewton final : public NewtonSolver {
 public:
  CheaperNewton(const System& system, const StepObjective& objective);
  void begin() override;
  void solve(const Vertices& x, const Vertices& gradient, double concavity, Vertices& direction) override;

  /// Whether the last equations were solved by the factor.
  [[nodiscard]] bool factors() const { return factors_; }

 private:
  /// Returns whether there is a factor.
  [[nodiscard]] bool make_factor();

  const System& system_;
  const StepObjective& objective_;
  ConjugateGradients iterated_;
  int patience_;                              // iterations worth a factor
  std::unique_ptr<NewtonCholesky> factored_;  // once it is needed
  bool factors_ = false, refused_ = false;
};

}  // namespace drape
