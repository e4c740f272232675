#pragma once

#include <array>
#include <vector>

#include "sim/cloth.hpp"

namespace drape {

/// A triangle's share of the bending energy, in terms of itself and of its neighbours' opposite vertices: at most six
/// vertices, v. Its curvature has three components q_a = Σ_c weights(a, c)·x(v_c), each a vector along the normal, and
///   E(x) = ½ Σ_a (‖q_a‖ − rest_a)².
/// A component's weights sum to zero, and it vanishes for every affine image of the flat triangles.
struct CurvatureElement {
  int count = 0;                        ///< vertices
  std::array<int, 6> vertices{};        ///< the first `count`
  Eigen::Matrix<double, 3, 6> weights;  ///< zero beyond `count` [√(N/m)]
  Eigen::Vector3d rest;                 ///< ‖q_a‖ of the rest shape [√J]
};

/// The elements of a cloth whose bending energy is ½ D ∫ ‖S − S₀‖² dA: D the bending rigidity [J], S the shape operator
/// [1/m] and S₀ that of the rest shape. A sheet rolled to radius R has ½ D A/R².
///
/// A hinge (an edge with two triangles of heights h and h' over it, which touch it at the fractions α and β of its
/// length) bends by
///   g = (x_A − (1−α) x_P − α x_Q)/h + (x_F − (1−β) x_P − β x_Q)/h',
/// a multiple of the cotangent formula of Bergou et al. 2006, "A quadratic bending model for inextensible surfaces",
/// section 3: where lengths are kept, ‖g‖ = 2 sin(θ/2), θ the angle between the triangles' normals. A surface with the
/// shape operator S has heights ½ xᵀSx, and so bends the hinge by a linear function of S. One hinge measures one number
/// of the three in S, and a weight for each hinge alone cannot make the energy independent of the directions of the
/// edges: on the homework's grid the bending energy would be three times as large along one diagonal as along the
/// other. The three hinges around a triangle determine S (as in Grinspun et al. 2006, "Computing discrete shape
/// operators on general meshes"): with Gram matrix W = M Mᵀ of the linear functions M, ‖S‖² = gᵀ W⁻¹ g, and the element
/// is the triangle's area times ½ D of it. It is exact for constant curvature on any mesh. On the cloth's border, where
/// a triangle has fewer hinges, it is the least ‖S‖² that bends them so: a share of the border's triangles, 1/N of an
/// N×N grid, resists less. Where the six vertices lie nearly on a conic, W is nearly singular: its eigenvalues, each
/// hinge measured by its height, are raised to 0.1, which no triangle with angles below 110° and similar neighbours
/// needs.
///
/// A triangle all of whose vertices are pinned is in a clamp: it does not bend, so it has no element, and a hinge
/// beside it measures the curvature of the cloth on its free side alone, over that side's height: g = ½ h nᵀSn, n
/// across the edge. Were it shared with the clamp, a clamped strip would be longer by half a cell.
///
/// Triangles without an area, and their edges, have no hinges.
/// @param rigidity D, positive [N·m]
std::vector<CurvatureElement> curvature_elements(const Cloth& cloth, double rigidity);

}  // namespace drape
