#pragma once

#include <vector>

#include "sim/cloth.hpp"

namespace drape {

/// A triangle's share of the bending energy, in terms of the vertices in and around it, v. Its curvature has three
/// components q_a = Σ_c weights(a, c)·x(v_c), each a vector along the normal, and
///   E(x) = ½ (‖q_0‖ − rest)² + ½ ‖q_1‖² + ½ ‖q_2‖².
/// A component's weights sum to zero; where the rest shape is flat, it vanishes for every affine image of it.
struct CurvatureElement {
  std::vector<int> vertices;                         ///< each once
  Eigen::Matrix<double, 3, Eigen::Dynamic> weights;  ///< a column for each vertex [√(N/m)]
  double rest = 0;                                   ///< ‖q_0‖ of the rest shape, where q_1 = q_2 = 0 [√J]
};

/// The elements of a cloth whose bending energy is ½ D ∫ ‖S − S₀‖² dA: D the bending rigidity [J], S the shape operator
/// [1/m] and S₀ that of the rest shape. A sheet rolled to radius R has ½ D A/R².
///
/// S is, up to the normal, the second derivative of the places, and a triangle's mean of it follows from the slopes
/// across its sides:
///   ∫ ∇∇x dA = Σ_sides l ∇x ⊗ n.
/// Along a side, ∇x is the difference of its ends over its length l. The slope across it would be an unknown of its
/// own in the element of Morley 1968, "The triangular equilibrium element in the solution of plate bending problems",
/// which converges on any mesh. Here it is taken from the vertices around (edge_slope), exactly for quadratic functions
/// and the same for both triangles at a side. So the energy is right for constant curvature, and never below that of
/// Morley's element with the best slopes: no ripple is cheaper than the curvature it makes up for. An energy of hinges
/// alone has such ripples: by the shape operators of Grinspun et al. 2006, "Computing discrete shape operators on
/// general meshes", a strip of alternating diagonals sags 40 % too far, however fine.
///
/// Slopes across the cloth's border are free, and minimise the triangle's energy: no moment acts there. So 1/N of an
/// N×N grid resists a curvature across the border less.
///
/// A triangle all of whose vertices are pinned is in a clamp: it does not bend, so it has no element, and its slope is
/// that of the cloth at its sides.
///
/// Of a rest shape that is not flat, the triangles around are unfolded, and the slopes inside the triangle are
/// subtracted from the second derivatives as often as leaves nothing along the triangle (the Christoffel symbols). The
/// components are chosen so that the first is along S₀.
///
/// Triangles without an area, and their edges, do not bend.
/// @param rigidity D, positive [N·m]
std::vector<CurvatureElement> curvature_elements(const Cloth& cloth, double rigidity);

}  // namespace drape
