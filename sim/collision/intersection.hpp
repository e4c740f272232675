#pragma once

#include <optional>
#include <utility>

#include "sim/mesh.hpp"

namespace drape {

/// An edge that passes through a triangle with which it has no vertex in common, the first there is; nothing if the
/// mesh nowhere goes through itself. An edge within a triangle's plane does not pass through it, also where rounding
/// has moved the vertices out of that plane, as when a flat cloth is turned. Nearly linear in the size of the mesh.
std::optional<std::pair<Edge, Triangle>> find_intersection(const std::vector<Triangle>& triangles, const Vertices& x);

}  // namespace drape
