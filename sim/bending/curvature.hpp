#pragma once

#include <array>
#include <utility>
#include <vector>

#include "drape/core/warp_weft.hpp"
#include "drape/sim/cloth.hpp"

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
///
/// A woven cloth has ½ ∫ ‖Q (S − S₀) Q‖² dA, where Q has the eigenvalues D₁^¼ along the warp and D₂^¼ along the weft.
/// The rigidity is D₁ for curvature along the warp, D₂ along the weft, √(D₁D₂) for twist, and for a sheet rolled at an
/// angle θ from the warp √D(θ) = cos²θ √D₁ + sin²θ √D₂ (Huber 1923).
/// A triangle where the warp has no direction has the rigidity √(D₁D₂).
/// @param rigidity D, or D₁ and D₂, positive [N·m]
std::vector<CurvatureElement> curvature_elements(const Cloth& cloth, const WarpWeft& rigidity);

/// A triangle of the rest shape, laid out in a plane.
struct PlacedTriangle {
  int triangle;
  std::array<Eigen::Vector2d, 3> corners;  ///< [m]
};

/// Triangles of a cloth's rest shape, and their neighbours. Side k of a triangle leads from its corner k to the next.
class RestSurface {
 public:
  /// Neighbour across a side: a triangle and its vertex opposite to that side, or −1 for both. At an edge of three or
  /// more triangles it is the next one.
  struct Beyond {
    int triangle = -1, opposite = -1;
  };

  /// Refers to the cloth, which must outlive it.
  explicit RestSurface(const Cloth& cloth);

  [[nodiscard]] int triangle_count() const { return static_cast<int>(held_.size()); }
  [[nodiscard]] const Triangle& triangle(int t) const { return cloth_.triangles[static_cast<std::size_t>(t)]; }
  [[nodiscard]] Eigen::Vector3d place(int vertex) const { return cloth_.rest.row(vertex).transpose(); }
  [[nodiscard]] const Beyond& beyond(int t, int side) const {
    return beyond_[3 * static_cast<std::size_t>(t) + static_cast<std::size_t>(side)];
  }
  /// Returns true if all its vertices are pinned.
  [[nodiscard]] bool held(int t) const { return held_[static_cast<std::size_t>(t)]; }
  /// Returns true if a triangle is free and has a neighbour.
  [[nodiscard]] bool bends(int t) const;

  /// Returns the triangle with corner 0 at the origin, corner 1 on the positive x axis, and corner 2 above it.
  [[nodiscard]] PlacedTriangle lay_out(int t) const;
  /// Returns the neighbour across a side, rotated around that side into the plane of `from`.
  [[nodiscard]] PlacedTriangle unfold(const PlacedTriangle& from, int side) const;

 private:
  const Cloth& cloth_;
  std::vector<Beyond> beyond_;
  std::vector<bool> held_;
};

/// Returns the outward unit normal of a side.
Eigen::Vector2d outward(const PlacedTriangle& t, int side);

/// A linear function of the vertices' positions, Σ weight·x(vertex). Vertices may repeat.
using LinearForm = std::vector<std::pair<int, double>>;

/// Returns the slope of a linear function on a triangle along a unit vector of its plane.
LinearForm slope_inside(const RestSurface& surface, const PlacedTriangle& t, const Eigen::Vector2d& along);

/// Returns the outward slope of a smooth function across a side of a triangle, at the middle of the side, from the
/// function's values at the surrounding vertices. Exact for quadratic functions of the unfolded rest shape.
///
/// If the triangle and its neighbour form a parallelogram, their four vertices determine the slope. Otherwise a
/// quadratic function is fitted by least squares to the vertices of both and of the triangles beyond their sides.
/// Further rings are added until it is determined. A patch ends at a clamp, and its function is fitted to the clamp's
/// slope. At the side of a clamp, the clamp's slope is the result.
/// @param t    a free triangle
/// @param side with a triangle beyond it
LinearForm edge_slope(const RestSurface& surface, const PlacedTriangle& t, int side);

}  // namespace drape
