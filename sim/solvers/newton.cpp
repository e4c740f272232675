#include "sim/solvers/newton.hpp"

#include "sim/linear/cheaper_newton.hpp"
#include "sim/parallel/vectors.hpp"

namespace drape {
namespace {

constexpr int newton_iterations = 20;  // the homework's
constexpr double fast = 0.5;           // ratio of successive ‖∇g‖ above which negative eigenvalues are used

std::unique_ptr<NewtonSolver> make_solver(LinearSolver choice, const System& system, const StepObjective& objective) {
  switch (choice) {
    case LinearSolver::cholesky:
      return std::make_unique<NewtonCholesky>(system, objective);
    case LinearSolver::conjugate_gradients:
      return std::make_unique<ConjugateGradients>(system, objective);
    case LinearSolver::automatic:
      break;
  }
  return std::make_unique<CheaperNewton>(system, objective);
}

}  // namespace

Newton::Newton(const System& system, const StepObjective& objective, const IntegratorSettings& settings)
    : Minimiser(system, objective, settings, default_iterations(settings, newton_iterations)),
      solver_(make_solver(settings.linear_solver, system, objective)),
      direction_(system.cloth.vertex_count(), 3) {}

void Newton::start() {
  concavity_ = 0;
  solver_->begin();
}

void Newton::find_newton_step(const Iterate& point, Vertices& direction) {
  solver_->solve(point.x, point.gradient, 0, direction);
}

double Newton::iterate(Iterate& point) {
  const Threads& threads = objective().threads();
  const double before = norm(threads, point.gradient);
  solver_->solve(point.x, point.gradient, concavity_, direction_);
  const double length = descend(point, direction_, dot(threads, point.gradient, direction_));
  const bool creeps = !(norm(threads, point.gradient) < fast * before);
  if (creeps && accuracy().rule != StoppingRule::change) concavity_ = 1;
  return length * norm(threads, direction_);
}

}  // namespace drape
