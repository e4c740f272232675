// ASCII USD, as a mesh, as a moving mesh and as a motion.

#include "scene/usd/mesh.hpp"
#include "scene/usd/motion.hpp"
#include "tests/fuzz/accepts_or_refuses.hpp"

namespace {

void check_triangles(const drape::Mesh& mesh) {
  if (!mesh.positions.allFinite()) std::abort();
  for (const drape::Triangle& triangle : mesh.triangles) {
    for (const int vertex : triangle) {
      if (vertex < 0 || vertex >= mesh.positions.rows()) std::abort();
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const drape::SourceText source("mesh.usda", std::string(data, data + size));
  drape::accepts_or_refuses([&] { check_triangles(drape::read_usd_mesh(source)); });
  drape::accepts_or_refuses([&] {
    const drape::MeshMotion motion = drape::read_usd_mesh_motion(source);
    check_triangles(motion.mesh);
    if (motion.samples.size() != motion.times.size()) std::abort();
    drape::Vertices x;
    for (const double time : {-1.0, 0.0, 0.3, 1e9}) {
      motion.place(time, x);
      if (x.rows() != motion.mesh.positions.rows() || !x.allFinite()) std::abort();
    }
  });
  drape::accepts_or_refuses([&] {
    const drape::UsdStage stage(source, {.primvar = "p"});
    const auto points = static_cast<int>(drape::read_usd_mesh(stage).positions.rows());
    for (const int point : drape::read_usd_primvar(stage, "", "p")) {
      if (point < 0 || point >= points) std::abort();
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
