#include "sim/mesh_motion.hpp"

#include "sim/between.hpp"

namespace drape {

void MeshMotion::place(double time, Vertices& x) const {
  if (samples.empty()) {
    x = mesh.positions;
    return;
  }
  const auto [before, after, share] = between(times, time);
  // At a sample itself its very bits.
  x = samples[before];
  if (before != after) x += share * (samples[after] - samples[before]);
}

}  // namespace drape
