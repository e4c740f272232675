#include "sim/effects/wind.hpp"

#include "core/keys.hpp"
#include "sim/effects/uniform_acceleration.hpp"

namespace drape {

void Wind::describe(Keys& keys) {
  keys.add("acceleration", &acceleration, "m/s²", "Acceleration of every vertex.").must_be_given();
}

void Wind::install(System& system) const {
  system.forces.push_back(std::make_unique<UniformAcceleration>(acceleration, system.cloth.masses));
}

}  // namespace drape
