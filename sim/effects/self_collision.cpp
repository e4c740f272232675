#include "sim/effects/self_collision.hpp"

#include <fmt/format.h>

#include "core/keys.hpp"
#include "sim/collision/intersection.hpp"
#include "sim/collision/self_contact.hpp"
#include "sim/contact/mesh_contacts.hpp"
#include "sim/effects/contact.hpp"
#include "sim/settings.hpp"
#include "sim/system.hpp"

namespace drape {

void SelfCollision::describe(Keys& keys) {
  keys.add("thickness", &thickness, "m", "Distance kept between layers of the cloth.").above(0);
  keys.add("repulsion", &repulsion, "1/s",
           "Rate at which layers that are too close separate, as a fraction of the missing distance per second.")
      .at_least(0);
  keys.add("friction", &friction, "", "Coefficient of Coulomb friction between layers.").at_least(0);
  keys.choice("response", response, {"explicit", "implicit", "solved"},
              "Contact is \"solved\" for with the whole step, see `ground`; or impulses after the step. Default: "
              "\"solved\" by explicit methods, \"explicit\" by the others.");
  keys.add("iterations", &iterations, "",
           "Passes over the contacts in a step, and over the collisions before the rest becomes rigid for that step.")
      .at_least(1);
}

void SelfCollision::check(const SimulationSettings& settings, const ProblemSink& problem) const {
  if (response == Response::implicit_energy) problem("response", "expected \"explicit\" or \"solved\"");
  if (response == Response::solved) {
    if (const auto wrong = solved_problem(settings)) problem("response", *wrong);
  }
  const Vertices& x = settings.cloth.positions;
  const double size = (x.colwise().maxCoeff() - x.colwise().minCoeff()).maxCoeff();
  // Everything would touch everything, in a time that grows with the square of the mesh's size.
  if (thickness > size) {
    problem("thickness", fmt::format("expected less than the size of the whole cloth at its start, {:g} m, found {:g}",
                                     size, thickness));
    return;
  }
  const auto found = find_intersection(settings.cloth.triangles, x);
  if (!found) return;
  const auto& [edge, triangle] = *found;
  problem("", fmt::format("the cloth starts intersecting itself, where neither side is the right one: the edge between "
                          "the vertices {} and {} passes through the triangle {}, {}, {}",
                          edge[0], edge[1], triangle[0], triangle[1], triangle[2]));
}

void SelfCollision::install(System& system) const {
  if (response_or_usual(response, system.impulses) == Response::solved) {
    const ContactTerms terms{.distance = thickness, .friction = friction};
    system.contacts.push_back(std::make_unique<SelfContacts>(terms, system.cloth, system.threads));
    return;
  }
  system.filters.push_back(std::make_unique<SelfContact>(*this, system.cloth, system.threads));
}

}  // namespace drape
