#pragma once

#include "drape/sim/mesh.hpp"

namespace drape::test {

/// Makes a mesh without any regularity that a solver could exploit: the n×n grid without a third of its cells, with
/// moved vertices and a fixed random numbering.
Mesh irregular_mesh(int n);

/// Makes three sheets of n×n cells that share one side: each edge of that side belongs to three triangles. Vertices 0
/// and n are the ends of the shared side, which lies on the x axis from −1 to 1; the sheets hang from it.
Mesh three_sheets(int n);

}  // namespace drape::test
