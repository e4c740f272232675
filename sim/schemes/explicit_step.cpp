#include "sim/schemes/explicit_step.hpp"

namespace drape {

Eigen::VectorXd explicit_pull(const System& system) {
  Eigen::VectorXd pull = -system.step * system.cloth.masses.cwiseInverse();
  for (const int pin : system.cloth.pins) pull[pin] = 0;
  return pull;
}

const Vertices& with_energies(const System& system, const Vertices& x, double time, const Vertices& force,
                              Vertices& scratch) {
  if (system.energies.empty()) return force;
  scratch.setZero(force.rows(), 3);
  for (const auto& energy : system.energies) energy->add_gradient(x, time, scratch);
  scratch = force - scratch;
  return scratch;
}

}  // namespace drape
