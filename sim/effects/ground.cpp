#include "sim/effects/ground.hpp"

#include "sim/effects/contact.hpp"

namespace drape {
namespace {

/// The half-space up·x < reach, which does not move.
struct GroundSurface {
  Eigen::Vector3d up;
  double reach;

  [[nodiscard]] const GroundSurface& at(double) const { return *this; }
  [[nodiscard]] Eigen::Vector3d displacement(double, double) const { return Eigen::Vector3d::Zero(); }

  bool find(const Eigen::Vector3d& point, Touch& touch) const {
    touch.depth = reach - up.dot(point);
    if (touch.depth <= 0) return false;
    touch.away = up;
    touch.distance = 1;
    return true;
  }
  [[nodiscard]] double clearance(const Eigen::Vector3d& point) const { return up.dot(point) - reach; }
  [[nodiscard]] const Eigen::Vector3d& normal(const Eigen::Vector3d&) const { return up; }
};

struct RestingGround final : ColliderMotion {
  GroundShape shape;
  explicit RestingGround(const GroundShape& s) : shape(s) {}
  [[nodiscard]] Collider at(double) const override { return shape; }
};

class Ground final : public Effect {
 public:
  Ground() {
    contact_.friction = 0.5;
    contact_.restitution = 0;
  }

  void describe(Keys& keys) override {
    keys.add("height", &height_, "m", "Its distance from the origin along its normal: for a level ground its z.")
        .must_be_given();
    keys.add("normal", &normal_, "", "The direction out of it, of any length: a ground can be tilted.");
    keys.add("thickness", &thickness_, "m",
             "Where it pushes: within this distance of the surface that is drawn, so that cloth lies on it and not in "
             "it.")
        .at_least(0);
    contact_.describe(keys, "");
  }

  void check(const SimulationSettings& settings, const ProblemSink& problem) const override {
    if (normal_.isZero(0)) problem("normal", "expected a direction, found [0, 0, 0]");
    contact_.check(settings, problem);
  }

  void install(System& system) const override {
    const Eigen::Vector3d normal = normal_.stableNormalized();
    system.colliders.push_back(std::make_unique<RestingGround>(GroundShape{normal, height_, thickness_}));
    install_contact(GroundSurface{normal, height_ + thickness_}, contact_, system);
  }

 private:
  double height_ = 0;
  Eigen::Vector3d normal_ = Eigen::Vector3d::UnitZ();
  double thickness_ = 0.02;
  ContactValues contact_;
};

}  // namespace

std::unique_ptr<Effect> make_ground() { return std::make_unique<Ground>(); }

}  // namespace drape
