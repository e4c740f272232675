#include "sim/schemes/backward_euler.hpp"

namespace drape {

BackwardEuler::BackwardEuler(const System& system, const MakeSolver& make_solver)
    : system_(system),
      objective_(system),
      solver_(make_solver(objective_)),
      books_(system, objective_, solver_->accuracy()),
      point_{.x = system.cloth.positions, .gradient = Vertices::Zero(system.cloth.vertex_count(), 3)},
      free_(is_free(system)) {}

StepReport BackwardEuler::advance(State& state, const Vertices& force) {
  system_.begin(state);
  objective_.begin(state, force);
  books_.begin(state, point_.x);
  point_.x = objective_.y();
  point_.value = objective_.evaluate(point_.x, point_.gradient);
  StepReport report = solver_->minimise(point_, [this] { return !books_.gains(point_, true); });
  // A step that a small change ended has been looked at.
  const bool looked = report.converged && solver_->accuracy().rule == StoppingRule::change;
  if (!looked && books_.gains(point_, report.converged)) {
    report.kept = books_.shed(point_);
    report.converged = false;
  }
  if (free_) balance_momentum();
  books_.end(point_);
  state.v = (point_.x - state.x) / system_.step;
  system_.move(state, &point_.x);
  system_.correct(state);
  return report;
}

void BackwardEuler::balance_momentum() {
  const Eigen::RowVector3d shift = mean(system_.cloth, objective_.y()) - mean(system_.cloth, point_.x);
  const double inertial = objective_.inertial_value(point_.x);
  point_.x.rowwise() += shift;
  point_.value += objective_.inertial_value(point_.x) - inertial;  // what it solves for is the same everywhere
  point_.gradient += objective_.inertia() * shift;
}

}  // namespace drape
