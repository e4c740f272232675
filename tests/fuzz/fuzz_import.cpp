// Motions of other programs: the first bytes select the reader, as in the formats.

#include <fstream>
#include <string>

#include "core/files.hpp"
#include "motion/import/import_motion.hpp"
#include "motion/import/motion_source.hpp"
#include "tests/fuzz/accepts_or_refuses.hpp"

namespace {

constexpr std::size_t most_moments = 100;

void require_sound(const drape::Mesh& mesh) {
  for (const drape::Triangle& triangle : mesh.triangles) {
    for (const int vertex : triangle) {
      if (vertex < 0 || vertex >= mesh.positions.rows()) std::abort();
    }
  }
  if (!mesh.uvs.empty() && mesh.uvs.size() != 3 * mesh.triangles.size()) std::abort();
}

/// Reads a motion as an import does.
void read_all(drape::MotionSource& motion) {
  require_sound(motion.mesh());
  if (motion.count() < 1) std::abort();
  static_cast<void>(motion.times());
  static_cast<void>(motion.rest());
  static_cast<void>(motion.fps());
  const drape::ImportedColliders colliders = motion.colliders();
  for (const auto& body : colliders.bodies) require_sound(body->mesh());
  for (const auto* shapes : {&colliders.spheres, &colliders.grounds}) {
    for (const auto& row : shapes->by_moment) {
      if (row.size() != shapes->by_moment.front().size()) std::abort();
    }
  }
  for (std::size_t i = 0; i < std::min(motion.count(), most_moments); ++i) {
    const drape::ImportedMoment moment = motion.moment(i);
    if (moment.x.rows() != motion.mesh().positions.rows() || !moment.x.allFinite()) std::abort();
  }
}

/// Runs the readers that need a file.
void read_file(const std::string& bytes, const std::string& ending) {
  static const drape::TemporaryFolder folder("drape-fuzz");
  const std::filesystem::path name = folder.path() / ("motion" + ending);
  std::ofstream(name, std::ios::binary) << bytes;
  std::ofstream(folder.path() / "motion.obj") << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  read_all(*drape::open_motion_source(name, {}, {}));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string bytes(data, data + size);
  drape::accepts_or_refuses([&] {
    if (bytes.starts_with("PK")) return read_file(bytes, ".npz");
    if (bytes.starts_with("POINTCACHE2")) return read_file(bytes, ".pc2");
    if (bytes.starts_with("#usda")) return read_file(bytes, ".usda");
    if (bytes.starts_with("ply")) return require_sound(drape::read_ply("m.ply", bytes).mesh);
    if (bytes.starts_with("<")) {
      drape::accepts_or_refuses([&] { drape::read_pvd("m.pvd", bytes); });
      return require_sound(drape::read_vtk_xml("m.vtp", bytes).mesh);
    }
    require_sound(drape::read_vtk_legacy("m.vtk", bytes).mesh);
  });
  return 0;
}
