// Wavefront OBJ.

#include "scene/mesh/source.hpp"
#include "tests/fuzz/accepts_or_refuses.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const drape::SourceText source("mesh.obj", std::string(data, data + size));
  drape::accepts_or_refuses([&] {
    const drape::Mesh mesh = drape::read_obj_mesh(source);
    if (!mesh.positions.allFinite()) std::abort();
    for (const drape::Triangle& triangle : mesh.triangles) {
      for (const int vertex : triangle) {
        if (vertex < 0 || vertex >= mesh.positions.rows()) std::abort();
      }
    }
  });
  drape::accepts_or_refuses([&] {
    for (const int vertex : drape::read_obj_group(source, "g")) {
      if (vertex < 0) std::abort();
    }
  });
  return 0;
}
