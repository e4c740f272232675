#include "sim/effects/gravity.hpp"

#include "sim/effects/uniform_acceleration.hpp"

namespace drape {
namespace {

class Gravity final : public Effect {
 public:
  void describe(Keys& keys) override {
    keys.add("acceleration", &acceleration_, "m/s²", "Acceleration of every vertex.");
  }
  void install(System& system) const override {
    system.gravity += acceleration_;
    system.forces.push_back(std::make_unique<UniformAcceleration>(acceleration_, system.cloth.masses));
  }

 private:
  Eigen::Vector3d acceleration_{0, 0, -9.8};
};

}  // namespace

std::unique_ptr<Effect> make_gravity() { return std::make_unique<Gravity>(); }

}  // namespace drape
