#include "drape/sim/settings.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <functional>

#include "drape/core/error.hpp"

namespace drape {
namespace {

void require_rows(const char* what, Eigen::Index rows, int vertices) {
  if (rows == vertices) return;
  throw UsageError(fmt::format("the cloth has {} vertices and {} {}", vertices, rows, what));
}

void require_vertex(const char* what, int vertex, int vertices) {
  if (vertex >= 0 && vertex < vertices) return;
  throw UsageError(fmt::format("a {} has vertex {}, but the vertices are 0 to {}", what, vertex, vertices - 1));
}

}  // namespace

void require_valid(const SimulationSettings& settings) {
  if (!(settings.step > 0) || !std::isfinite(settings.step)) {
    throw UsageError(fmt::format("the step must be above 0 s, found {:g} s", settings.step));
  }
  const Cloth& cloth = settings.cloth;
  const int vertices = cloth.vertex_count();
  require_rows("velocities", cloth.velocities.rows(), vertices);
  if (cloth.rest.rows() > 0) require_rows("rest positions", cloth.rest.rows(), vertices);  // springs do not need it
  require_rows("masses", cloth.masses.size(), vertices);
  for (const Triangle& triangle : cloth.triangles) {
    for (const int vertex : triangle) require_vertex("triangle", vertex, vertices);
  }
  for (const Spring& spring : cloth.springs) {
    for (const int vertex : {spring.i, spring.j}) require_vertex("spring", vertex, vertices);
  }
  for (const int pin : cloth.pins) require_vertex("pin", pin, vertices);
  for (const Seam& seam : cloth.seams) {
    for (const SeamTie& tie : seam.ties) {
      for (const int vertex : {tie.vertex, tie.edge[0], tie.edge[1]}) require_vertex("seam", vertex, vertices);
    }
  }
  if (std::ranges::adjacent_find(cloth.pins, std::greater_equal<>()) == cloth.pins.end()) return;
  throw UsageError("the pins must be ascending, each once");
}

}  // namespace drape
