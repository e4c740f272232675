#pragma once

#include <string>
#include <vector>

#include "drape/sim/cloth.hpp"
#include "drape/sim/mesh.hpp"

namespace drape::test {

/// Meshes of a sheet that bends: cells with one diagonal, alternating diagonals or both ("X"), also four times as wide
/// as long; Delaunay triangulations of random points, plain and relaxed to the middle of their neighbours.
enum class Division { diagonal, alternating, crossed, wide_alternating, wide_crossed, delaunay, relaxed };

/// Returns "Diagonal", "Alternating", …
std::string name_of(Division division);
std::vector<Division> all_divisions();

/// A triangulation in the plane z = 0.
struct Sheet {
  Mesh mesh;
  std::vector<int> pins;
};

/// Makes a strip from the origin along x with the given numbers of cells along and across it; of wide cells a quarter
/// as many. One more column of cells before it is pinned: a clamp.
Sheet clamped_strip(Division division, int cells, int across, double length);

/// Returns the mean drop of the free end of such a strip, which begins in the plane z = 0.
/// @param x positions of the strip's vertices
double tip_drop(const Sheet& strip, const Vertices& x);

/// Makes the square [0, 1]² of n×n cells (n×n/4 wide ones), within a frame of pinned cells.
Sheet clamped_square(Division division, int n);

/// Makes a cloth defined by density and rigidity alone; its springs are irrelevant.
Cloth cloth_of(const Sheet& sheet, double density);

}  // namespace drape::test
