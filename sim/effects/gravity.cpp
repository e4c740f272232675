#include "drape/sim/effects/gravity.hpp"

#include "core/keys.hpp"
#include "sim/effects/uniform_acceleration.hpp"

namespace drape {

void Gravity::describe(Keys& keys) { keys.add("acceleration", &acceleration, "m/s²", "Acceleration of every vertex."); }

void Gravity::install(System& system) const {
  system.gravity += acceleration;
  system.forces.push_back(std::make_unique<UniformAcceleration>(acceleration, system.cloth.masses));
}

}  // namespace drape
