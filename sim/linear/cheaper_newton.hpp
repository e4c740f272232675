#pragma once

#include <memory>

#include "sim/linear/conjugate_gradients.hpp"
#include "sim/linear/newton_cholesky.hpp"

namespace drape {

/// Solver of Newton's equations by conjugate gradients while these take less work than a factor of H. Work is counted
/// in operations, so the choice is the same on every machine. Each minimisation begins with conjugate gradients. It
/// keeps to them if the factor is rejected, for lack of memory or because the mesh is unlike a surface.
class CheaperNewton final : public NewtonSolver {
 public:
  CheaperNewton(const System& system, const StepObjective& objective);
  void begin() override;
  void solve(const Vertices& x, const Vertices& gradient, double concavity, Vertices& direction) override;

  /// Returns true if the factor solved the last equations.
  [[nodiscard]] bool factors() const { return factors_; }

 private:
  /// Makes the factor if possible; returns true if there is one.
  [[nodiscard]] bool make_factor();

  const System& system_;
  const StepObjective& objective_;
  ConjugateGradients iterated_;
  int patience_;                              // number of iterations that cost as much as a factor
  std::unique_ptr<NewtonCholesky> factored_;  // created on first use
  bool factors_ = false, refused_ = false;
};

}  // namespace drape
