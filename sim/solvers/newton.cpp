#include "sim/solvers/newton.hpp"

#include "sim/linear/conjugate_gradients.hpp"
#include "sim/linear/newton_cholesky.hpp"
#include "sim/parallel/vectors.hpp"

namespace drape {
namespace {

constexpr int newton_iterations = 20;  // the homework's

std::unique_ptr<NewtonSolver> make_solver(LinearSolver choice, const System& system, const StepObjective& objective) {
  if (choice == LinearSolver::cholesky) return std::make_unique<NewtonCholesky>(system, objective);
  return std::make_unique<ConjugateGradients>(system, objective);
}

}  // namespace

Newton::Newton(const System& system, const StepObjective& objective, const IntegratorSettings& settings)
    : Minimiser(system, objective, settings, newton_iterations),
      solver_(make_solver(settings.linear_solver, system, objective)),
      direction_(system.cloth.vertex_count(), 3) {}

void Newton::find_newton_step(const Iterate& point, Vertices& direction) {
  solver_->solve(point.x, point.gradient, direction);
}

double Newton::iterate(Iterate& point) {
  find_newton_step(point, direction_);
  return descend(point, direction_, dot(objective().threads(), point.gradient, direction_)) *
         norm(objective().threads(), direction_);
}

}  // namespace drape
