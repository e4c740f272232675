#include "drape/sim/effects/internal_damping.hpp"

#include "core/keys.hpp"
#include "sim/dashpots.hpp"

namespace drape {

void InternalDamping::describe(Keys& keys) {
  keys.add("relaxation_time", &relaxation_time, "s",
           "Time τ: a spring of stiffness k has a dashpot with the damping coefficient τ·k, and bending likewise.")
      .must_be_given()
      .above(0);
}

void InternalDamping::install(System& system) const {
  const int count = system.cloth.vertex_count();
  system.damping_time = relaxation_time;
  if (!system.springs.empty()) {
    system.dashpots.push_back(std::make_shared<SpringDashpots>(system.springs, relaxation_time, count, system.threads));
  }
  if (!system.bending_elements.empty()) {
    system.dashpots.push_back(std::make_shared<BendingDashpots>(system.bending_elements, relaxation_time));
  }
}

}  // namespace drape
