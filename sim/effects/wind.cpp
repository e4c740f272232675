#include "sim/effects/wind.hpp"

#include "sim/effects/uniform_acceleration.hpp"

namespace drape {
namespace {

class Wind final : public Effect {
 public:
  void describe(Keys& keys) override {
    keys.add("acceleration", &acceleration_, "m/s²", "Acceleration of every vertex.").must_be_given();
  }
  void install(System& system) const override {
    system.forces.push_back(std::make_unique<UniformAcceleration>(acceleration_, system.cloth.masses));
  }

 private:
  Eigen::Vector3d acceleration_ = Eigen::Vector3d::Zero();
};

}  // namespace

std::unique_ptr<Effect> make_wind() { return std::make_unique<Wind>(); }

}  // namespace drape
