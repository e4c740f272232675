#include "drape/sim/effects/bending.hpp"

#include "core/keys.hpp"
#include "sim/bending/bending_energy.hpp"

namespace drape {

void Bending::describe(Keys& keys) {
  keys.add("rigidity", &rigidity, "N·m",
           "Bending rigidity D: an area A rolled to radius R stores the energy ½·D·A/R². Two numbers: rolled along the "
           "warp and along the weft, see [cloth] `warp`.")
      .above(0);
  keys.add("cross_stiffness", &cross_stiffness, "N/m",
           "Stiffness of \"cross\" springs between the two vertices opposite each inner edge.")
      .above(0);
}

void Bending::check(const SimulationSettings&, const ProblemSink& problem) const {
  if (!rigidity && !cross_stiffness) {
    problem("", "expected 'rigidity', 'cross_stiffness' or both; with neither, nothing resists bending");
  }
}

void Bending::install(System& system) const {
  if (cross_stiffness) {
    const std::vector<Spring> springs = cross_springs(system.cloth, *cross_stiffness);
    system.springs.insert(system.springs.end(), springs.begin(), springs.end());
  }
  if (rigidity) {
    system.bending_rigidity += *rigidity;
    const auto elements = curvature_elements(system.cloth, *rigidity);
    if (!elements.empty())
      system.energies.push_back(std::make_unique<BendingEnergy>(elements, system.cloth.vertex_count(), system.threads));
  }
}

}  // namespace drape
