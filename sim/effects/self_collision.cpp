#include "drape/sim/effects/self_collision.hpp"

#include <fmt/format.h>

#include "core/keys.hpp"
#include "drape/sim/settings.hpp"
#include "sim/contact/mesh_contacts.hpp"
#include "sim/effects/effect_keys.hpp"
#include "sim/system.hpp"

namespace drape {

void SelfCollision::describe(Keys& keys) {
  keys.add("thickness", &thickness, "m", "Distance kept between layers of the cloth.").above(0);
  describe_friction(keys, friction);
  describe_overlap(keys, allow_overlap);
  keys.replace("repulsion", "layers that are too near part at 20 times what is missing per second: omit it");
  keys.replace("iterations", "contact is solved for until it holds: omit it");
}

void SelfCollision::check(const SimulationSettings& settings, const ProblemSink& problem) const {
  const Vertices& x = settings.cloth.positions;
  const double size = (x.colwise().maxCoeff() - x.colwise().minCoeff()).maxCoeff();
  // All features would touch each other, and the time would grow with the square of the mesh size.
  if (thickness > size) {
    problem("thickness", fmt::format("expected less than the size of the whole cloth at its start, {:g} m, found {:g}",
                                     size, thickness));
  }
}

void SelfCollision::install(System& system) const {
  const ContactTerms terms{.distance = thickness, .friction = friction, .separate = allow_overlap};
  system.contacts.push_back(std::make_unique<SelfContacts>(terms, system.cloth, system.threads));
}

}  // namespace drape
