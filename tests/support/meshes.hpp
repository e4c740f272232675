#pragma once

#include "sim/mesh.hpp"

namespace drape::test {

/// A mesh without any order that a solver could profit from: the n×n grid with a third of its cells removed, moved
/// vertices and a random numbering, always the same.
Mesh irregular_mesh(int n);

/// Three sheets of n×n cells that share one side: every edge of that side belongs to three triangles. Vertices 0 and n
/// are the ends of the shared side, which lies on the x axis from −1 to 1; the sheets hang down from it.
Mesh three_sheets(int n);

}  // namespace drape::test
