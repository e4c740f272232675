#include "drape/sim/effects/ground.hpp"

#include "sim/contact/contact.hpp"
#include "sim/contact/mesh_contacts.hpp"
#include "sim/effects/effect_keys.hpp"
#include "sim/system.hpp"

namespace drape {
namespace {

struct RestingGround final : ColliderMotion {
  GroundShape shape;
  explicit RestingGround(const GroundShape& s) : shape(s) {}
  [[nodiscard]] Collider at(double) const override { return shape; }
  [[nodiscard]] bool rests() const override { return true; }
};

}  // namespace

void Ground::describe(Keys& keys) {
  keys.add("height", &height, "m", "Distance from the origin along its normal: for a level ground, its z.");
  keys.add("normal", &normal, "", "Outward direction, of any length; a ground can be tilted.");
  keys.add("thickness", &thickness, "m",
           "Distance that the cloth keeps from the drawn surface, so that it lies on it and not in it.")
      .at_least(0);
  describe_obstacle(keys, friction, &restitution);
  describe_overlap(keys, allow_overlap);
}

void Ground::check(const SimulationSettings&, const ProblemSink& problem) const {
  if (normal.isZero(0)) problem("normal", "expected a direction, found [0, 0, 0]");
}

void Ground::install(System& system) const {
  const Eigen::Vector3d up = normal.stableNormalized();
  system.colliders.push_back(std::make_unique<RestingGround>(GroundShape{up, height, thickness}));
  const ContactTerms terms{thickness, friction, restitution};
  system.contacts.push_back(std::make_unique<SurfaceContacts<PlaneObstacle>>(PlaneObstacle{up, height}, terms));
}

}  // namespace drape
