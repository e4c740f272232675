#include "sim/linear/cheaper_newton.hpp"

#include "core/error.hpp"

namespace drape {

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
