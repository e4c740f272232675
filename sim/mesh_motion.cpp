#include "sim/mesh_motion.hpp"

#include "sim/between.hpp"

namespace drape {

void MeshMotion::place(double time, Vertices& x) const {
  if (samples.empty()) {
    x = mesh.positions;
    return;
  }
  const auto [before, after, share] = between(times, time);
  // Exactly the sample at its own time.
  x = samples[before];
  if (before != after) x += share * (samples[after] - samples[before]);
}

}  // namespace drape
