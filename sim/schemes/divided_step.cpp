#include "sim/schemes/divided_step.hpp"

namespace drape {

StepReport DividedStep::advance(State& state, StepForces& forces) {
  StepReport report;
  const std::int64_t step = state.step;
  for (std::int64_t k = 0; k < system_.substeps; ++k) {
    system_.stop.look();
    state.step = step * system_.substeps + k;
    const StepReport substep = scheme_->advance(state, forces);
    report.converged = report.converged && substep.converged;
    for (const auto& filter : system_.filters) report.converged = report.converged && filter->converged();
  }
  state.step = step;
  report.substeps = system_.substeps;
  return report;
}

}  // namespace drape
