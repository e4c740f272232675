#include "drape/sim/effects/bending.hpp"

#include "core/keys.hpp"
#include "sim/bending/bending_energy.hpp"
#include "sim/effects/effect_keys.hpp"

namespace drape {

void Bending::describe(Keys& keys) {
  keys.add("rigidity", &rigidity, "N·m",
           "Bending rigidity D: an area A rolled to radius R stores the energy ½·D·A/R². Two numbers: rolled along the "
           "warp and along the weft, see [cloth] `warp`.")
      .above(0);
  keys.add("cross_stiffness", &cross_stiffness, "N/m",
           "Stiffness of \"cross\" springs between the two vertices opposite each inner edge.")
      .above(0);
  describe_cloth(keys, cloth);
}

void Bending::check(const SimulationSettings& settings, const ProblemSink& problem) const {
  check_cloth(cloth, settings, problem);
  check_acts_alone(*this, settings, problem);
  if (!rigidity && !cross_stiffness) {
    problem("", "expected 'rigidity', 'cross_stiffness' or both; with neither, nothing resists bending");
  }
}

void Bending::install(System& system) const {
  for_cloths(system.cloth, cloth, [&](const Cloth& one, int piece) {
    if (cross_stiffness) {
      const std::vector<Spring> springs = cross_springs(one, *cross_stiffness);
      system.springs.insert(system.springs.end(), springs.begin(), springs.end());
    }
    if (!rigidity) return;
    const auto elements = curvature_elements(one, *rigidity);
    if (elements.empty()) return;
    system.bending_elements.insert(system.bending_elements.end(), elements.begin(), elements.end());
    system.energies.push_back(std::make_unique<BendingEnergy>(elements, one.vertex_count(), system.threads));
    system.energies.back()->piece = piece;
  });
}

}  // namespace drape
