#pragma once

#include <vector>

#include "sim/cloth.hpp"

namespace drape {

/// Gives the springs of a grid whose cells have both diagonals, alternating or crossed, the stiffnesses of a cloth that
/// is the same in all directions: E along any, with a Poisson's ratio of 1/3. Those along x, those along y and the
/// diagonals have the shares that make it so, where stiffen_by_area gives each the area at it. Cells longer than √3
/// times their width would need springs that push; they get those of stiffen_by_area.
/// @param modulus E, force per width and strain, positive [N/m]
/// @param cloth   whose rest shape is such a grid along x and y
void stiffen_evenly(double modulus, Cloth& cloth);

/// Stiffnesses of the springs of a course's cloth [N/m].
struct GridSprings {
  double structural;  ///< along the sides of cells
  double shear;       ///< along both diagonals of every cell
  double bend;        ///< between every other vertex of a row or column
};

/// The springs of a course's cloth, sorted by vertices.
/// @param columns of the grid's cells
/// @param rest    its (columns + 1)·(rows + 1) vertices in row-major order, at least two rows
std::vector<Spring> springs_of_grid(int columns, const Vertices& rest, const GridSprings& stiffnesses);

}  // namespace drape
