#pragma once

#include <string>
#include <vector>

#include "sim/cloth.hpp"
#include "sim/mesh.hpp"

namespace drape::test {

/// Ways to divide a sheet that is to bend: cells of one diagonal, alternating ones or both ("X"), also four times as
/// wide as long; Delaunay triangulations of random places, as they are and moved to the middle of what is around them.
enum class Division { diagonal, alternating, crossed, wide_alternating, wide_crossed, delaunay, relaxed };

/// "Diagonal", "Alternating", …
std::string name_of(Division division);
std::vector<Division> all_divisions();

/// A triangulation in the plane of z = 0.
struct Sheet {
  Mesh mesh;
  std::vector<int> pins;
};

/// A strip from the origin along x with so many cells along it and across, of which wide ones are a quarter as many.
/// Before it is one more column of cells that is pinned: a clamp.
Sheet clamped_strip(Division division, int cells, int across, double length);

/// The square [0, 1]² of n×n cells (of wide ones n×n/4), within a frame of cells that is pinned.
Sheet clamped_square(Division division, int n);

/// A cloth of density and rigidity alone, whose springs are irrelevant.
Cloth cloth_of(const Sheet& sheet, double density);

}  // namespace drape::test
