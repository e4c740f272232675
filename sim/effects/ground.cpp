#include "sim/effects/ground.hpp"

#include "core/keys.hpp"
#include "sim/contact/obstacles.hpp"
#include "sim/contact/surface_contacts.hpp"
#include "sim/effects/contact.hpp"

namespace drape {
namespace {

/// The half-space up·x < height, which does not move.
struct GroundSurface {
  Eigen::Vector3d up;
  double height;

  [[nodiscard]] const GroundSurface& at(double) const { return *this; }
  [[nodiscard]] Eigen::Vector3d displacement(double, double) const { return Eigen::Vector3d::Zero(); }

  bool find(const Eigen::Vector3d& point, SurfaceContact& contact) const {
    contact.gap = gap(point);
    if (contact.gap >= 0) return false;
    contact.outward = up;
    contact.length = 1;
    return true;
  }
  [[nodiscard]] double gap(const Eigen::Vector3d& point) const { return up.dot(point) - height; }
  [[nodiscard]] const Eigen::Vector3d& normal(const Eigen::Vector3d&) const { return up; }
};

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
           "Reach of the push: within this distance of the drawn surface, so that cloth lies on it and not in it.")
      .at_least(0);
  describe_contact(keys, stiffness, response, friction, restitution, "");
}

void Ground::check(const SimulationSettings& settings, const ProblemSink& problem) const {
  if (normal.isZero(0)) problem("normal", "expected a direction, found [0, 0, 0]");
  law(has_impulses(settings)).check(settings, problem);
}

void Ground::install(System& system) const {
  const Eigen::Vector3d up = normal.stableNormalized();
  system.colliders.push_back(std::make_unique<RestingGround>(GroundShape{up, height, thickness}));
  const ContactLaw contact = law(system.impulses);
  if (contact.response == Response::solved) {
    const ContactTerms terms{thickness, friction, restitution.value_or(0)};
    system.contacts.push_back(std::make_unique<SurfaceContacts<PlaneObstacle>>(PlaneObstacle{up, height}, terms));
    return;
  }
  install_contact(GroundSurface{up, height + thickness}, contact, system);
}

ContactLaw Ground::law(bool impulses) const {
  return {stiffness, response_or_usual(response, impulses && !stiffness), friction, restitution};
}

}  // namespace drape
