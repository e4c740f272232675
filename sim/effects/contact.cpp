#include "sim/effects/contact.hpp"

#include <utility>

namespace drape {

void describe_friction(Keys& keys, double& friction) {
  keys.add("friction", &friction, "",
           "Coulomb's coefficient µ: what rests on a slope of tan θ ≤ µ stays there; 0 is frictionless.")
      .at_least(0);
  keys.replace("response", "contact is solved for with the step, by every method: omit it");
}

void describe_overlap(Keys& keys, bool& allow_overlap) {
  keys.add("allow_overlap", &allow_overlap, "",
           "Whether the cloth may begin inside or across it: they are separated step by step. Otherwise that is an "
           "error.");
}

void describe_obstacle(Keys& keys, double& friction, Key::Target restitution) {
  describe_friction(keys, friction);
  keys.add("restitution", std::move(restitution), "",
           "Fraction of its impact speed with which a vertex rebounds: 1 all of it, 0 none.")
      .at_least(0)
      .at_most(1);
  keys.replace("stiffness", "contact is solved for and has none: omit it");
}

}  // namespace drape
