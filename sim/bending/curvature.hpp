#pragma once

#include <vector>

#include "sim/cloth.hpp"

namespace drape {

/// A triangle's share of the bending energy, in terms of the vertices v in and around it. Its curvature has three
/// components q_a = Σ_c weights(a, c)·x(v_c), each a vector along the normal, and
///   E(x) = ½ (‖q_0‖ − rest)² + ½ ‖q_1‖² + ½ ‖q_2‖².
/// The weights of a component sum to zero. For a flat rest shape it vanishes on every affine image of that.
struct CurvatureElement {
  std::vector<int> vertices;                         ///< without duplicates
  Eigen::Matrix<double, 3, Eigen::Dynamic> weights;  ///< one column per vertex [√(N/m)]
  double rest = 0;                                   ///< ‖q_0‖ of the rest shape, which has q_1 = q_2 = 0 [√J]
};

/// Returns the elements of a cloth with the bending energy ½ D ∫ ‖S − S₀‖² dA. D is the bending rigidity [J], S the
/// shape operator [1/m] and S₀ that of the rest shape. A sheet rolled to radius R has ½ D A/R².
///
/// S is, up to the normal, the second derivative of the positions. Its mean over a triangle follows from the slopes
/// across the sides:
///   ∫ ∇∇x dA = Σ_sides l ∇x ⊗ n.
/// Along a side of length l, ∇x is the difference of its ends over l. The slope across it would be an extra unknown in
/// the element of Morley 1968, "The triangular equilibrium element in the solution of plate bending problems", which
/// converges on any mesh. Here the surrounding vertices determine it (edge_slope), exactly for quadratic functions and
/// equally for both triangles at a side. So the energy is right for constant curvature, and never below that of
/// Morley's element with the best slopes: no ripple is cheaper than the curvature it replaces. Energies of hinges alone
/// allow such ripples: with the shape operators of Grinspun et al. 2006, "Computing discrete shape operators on general
/// meshes", a strip of alternating diagonals sags 40 % too far at any resolution.
///
/// Slopes across the cloth's border are free and minimise the triangle's energy, as no moment acts there. So 1/N of an
/// N×N grid resists a curvature across the border less.
///
/// A triangle with all vertices pinned is a clamp: it does not bend, has no element, and gives its slope to the cloth
/// at its sides.
///
/// For a curved rest shape, the surrounding triangles are unfolded. Slopes inside the triangle are then subtracted from
/// the second derivatives so that no tangential part remains (the Christoffel symbols). The first component is chosen
/// along S₀.
///
/// Triangles without an area, and their edges, do not bend.
/// @param rigidity D, positive [N·m]
std::vector<CurvatureElement> curvature_elements(const Cloth& cloth, double rigidity);

}  // namespace drape
