#include "sim/mesh_motion.hpp"

#include <algorithm>

namespace drape {

void MeshMotion::place(double time, Vertices& x) const {
  if (samples.empty()) {
    x = mesh.positions;
    return;
  }
  const auto after = std::ranges::upper_bound(times, time) - times.begin();
  if (after == 0) {
    x = samples.front();
  } else if (after == std::ssize(times)) {
    x = samples.back();
  } else {
    const auto k = static_cast<std::size_t>(after);
    const double share = (time - times[k - 1]) / (times[k] - times[k - 1]);
    // At a sample itself its very bits.
    x = samples[k - 1];
    if (share != 0) x += share * (samples[k] - samples[k - 1]);
  }
}

}  // namespace drape
