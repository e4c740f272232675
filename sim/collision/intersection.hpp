#pragma once

#include <optional>
#include <utility>

#include "sim/mesh.hpp"

namespace drape {

/// An edge that passes through a triangle with which it has no vertex in common, the first there is; nothing if the
/// mesh nowhere goes through itself. Nearly linear in the size of the mesh.
std::optional<std::pair<Edge, Triangle>> find_intersection(const std::vector<Triangle>& triangles, const Vertices& x);

}  // namespace drape
