#include "sim/effects/self_collision.hpp"

#include <fmt/format.h>

#include "core/keys.hpp"
#include "sim/collision/intersection.hpp"
#include "sim/contact/mesh_contacts.hpp"
#include "sim/effects/contact.hpp"
#include "sim/settings.hpp"
#include "sim/system.hpp"

namespace drape {

void SelfCollision::describe(Keys& keys) {
  keys.add("thickness", &thickness, "m", "Distance kept between layers of the cloth.").above(0);
  describe_friction(keys, friction);
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
  const ContactTerms terms{.distance = thickness, .friction = friction};
  system.contacts.push_back(std::make_unique<SelfContacts>(terms, system.cloth, system.threads));
}

}  // namespace drape
