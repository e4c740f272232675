// ASCII USD, as a mesh and as a motion.

#include "scene/usd/mesh.hpp"
#include "scene/usd/motion.hpp"
#include "tests/fuzz/accepts_or_refuses.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const drape::SourceText source("mesh.usda", std::string(data, data + size));
  drape::accepts_or_refuses([&] {
    const drape::Mesh mesh = drape::read_usd_mesh(source);
    if (!mesh.positions.allFinite()) std::abort();
    for (const drape::Triangle& triangle : mesh.triangles) {
      for (const int vertex : triangle) {
        if (vertex < 0 || vertex >= mesh.positions.rows()) std::abort();
      }
    }
  });
  drape::accepts_or_refuses([&] {
    const drape::TransformTrack track = drape::read_usd_motion(source);
    for (const double time : {-1.0, 0.0, 0.3, 1e9}) {
      if (!track.sphere_at(time).center.allFinite()) std::abort();
    }
  });
  return 0;
}
