#pragma once

#include <optional>
#include <utility>

#include "sim/mesh.hpp"

namespace drape {

/// Returns the first edge that passes through a triangle with which it shares no vertex, or nothing. An edge in a
/// triangle's plane does not pass through it, even if rounding moved vertices out of the plane, as when a flat cloth is
/// turned. Nearly linear in the size of the mesh.
std::optional<std::pair<Edge, Triangle>> find_intersection(const std::vector<Triangle>& triangles, const Vertices& x);

}  // namespace drape
