#include "drape/sim/effects/self_collision.hpp"

#include <fmt/format.h>
#include <algorithm>

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
  keys.add("contact", &contact, "",
           "Friction between two named cloths, instead of `friction`. A name given twice: of a cloth with itself.");
  keys.replace("repulsion",
               "close layers separate by themselves, each second by 20 times the missing distance: omit it");
  keys.replace("iterations", "contact is solved for until it holds: omit it");
}

void SelfCollision::check(const SimulationSettings& settings, const ProblemSink& problem) const {
  std::vector<std::array<std::string, 2>> known;
  for (const ClothFriction& pair : contact) {
    for (const std::string& name : pair.cloths) {
      check_cloth(name, settings, [&](std::string_view, const std::string& text) { problem("contact", text); });
    }
    auto ordered = pair.cloths;
    std::ranges::sort(ordered);
    if (std::ranges::find(known, ordered) != known.end()) {
      problem("contact", fmt::format("'{}' and '{}' are given twice", pair.cloths[0], pair.cloths[1]));
    }
    known.push_back(ordered);
  }
  const Vertices& x = settings.cloth.positions;
  const double size = (x.colwise().maxCoeff() - x.colwise().minCoeff()).maxCoeff();
  // All features would touch each other, and the time would grow with the square of the mesh size.
  if (thickness > size) {
    problem("thickness", fmt::format("expected less than the size of the whole cloth at its start, {:g} m, found {:g}",
                                     size, thickness));
  }
}

void SelfCollision::install(System& system) const {
  ContactTerms terms{.distance = thickness, .friction = friction, .separate = allow_overlap};
  const std::vector<ClothPiece>& pieces = system.cloth.pieces;
  const auto count = static_cast<Eigen::Index>(pieces.size());
  Eigen::MatrixXd frictions = Eigen::MatrixXd::Constant(count, count, friction);
  for (const ClothFriction& pair : contact) {
    const auto number = [&](const std::string& name) {
      return std::ranges::find(pieces, name, &ClothPiece::name) - pieces.begin();
    };
    const Eigen::Index i = number(pair.cloths[0]), j = number(pair.cloths[1]);
    frictions(i, j) = frictions(j, i) = pair.friction;
  }
  if (count == 1) terms.friction = frictions(0, 0);
  system.contacts.push_back(std::make_unique<SelfContacts>(terms, system.cloth, system.threads, frictions));
}

}  // namespace drape
