#pragma once

#include <vector>

#include "sim/cloth.hpp"

namespace drape {

/// Gives the springs of a grid with alternating or crossed diagonals the stiffnesses of an isotropic cloth, with
/// modulus E and a Poisson's ratio of 1/3. The springs along x, along y and the diagonals get the shares that achieve
/// this; stiffen_by_area uses the areas instead. Cells longer than √3 times their width would need pushing springs and
/// use stiffen_by_area.
/// @param modulus E, force per width and strain, positive [N/m]
/// @param cloth   whose rest shape is such a grid along x and y
void stiffen_evenly(double modulus, Cloth& cloth);

/// Stiffnesses of the springs of a course's cloth [N/m].
struct GridSprings {
  double structural;  ///< along the sides of cells
  double shear;       ///< along both diagonals of every cell
  double bend;        ///< between every other vertex of a row or column
};

/// Returns the springs of a course's cloth, sorted by vertices.
/// @param columns of the grid's cells
/// @param rest    its (columns + 1)·(rows + 1) vertices in row-major order, at least two rows
std::vector<Spring> springs_of_grid(int columns, const Vertices& rest, const GridSprings& stiffnesses);

}  // namespace drape
