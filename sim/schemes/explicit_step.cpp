#include "sim/schemes/explicit_step.hpp"

#include <fmt/format.h>

#include "core/error.hpp"

namespace drape {

Eigen::VectorXd explicit_pull(const System& system, const char* name) {
  if (!system.all_internal()) {
    throw UsageError(fmt::format(
        "{} solves for nothing: it cannot have an energy that is, such as a contact with response = \"implicit\"",
        name));
  }
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
