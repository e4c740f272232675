#pragma once

#include <span>
#include <vector>

#include "drape/sim/cloth.hpp"
#include "sim/system.hpp"

namespace drape {

/// A connected part of a mesh without border: each of its edges has exactly two triangles.
struct ClosedPiece {
  /// Triangles of the mesh, turned so that all fronts face outwards.
  std::vector<Triangle> triangles;
};

/// Returns the pieces of a cloth, in the order of their first triangle. A piece whose triangles face different sides is
/// turned to one orientation: to a positive volume of the rest shape, else of the initial shape. If both are flat, its
/// first triangle keeps its front. Triangles with a repeated vertex belong to no piece.
/// @throws std::invalid_argument with a sentence that names an edge, if the cloth has no triangles or an edge without
///         exactly two, or if a piece has only one side
std::vector<ClosedPiece> closed_pieces(const Cloth& cloth);

/// Returns the volume inside of triangles that face outwards [m³]. It is summed about one of their vertices, so the
/// distance from the origin costs no accuracy.
/// @param x positions, n×3 [m]
double enclosed_volume(const std::vector<Triangle>& triangles, const Vertices& x);

/// Returns the sum of the triangles' areas [m²].
double surface_area(const std::vector<Triangle>& triangles, const Vertices& x);

/// Gas in a closed piece at constant temperature. Its pressure above that outside is p(V) = N/V − a, with N = nRT and
/// the pressure a outside. A constant pressure p is N = 0 and a = −p.
///
/// Its energy is E(V) = N ln(V₀/V) + a (V − V₀), with a reference V₀ such that E ≥ 0: the volume where p = 0, or the
/// largest one. Volumes outside of (0, most] have an infinite energy.
class GasLaw {
 public:
  /// @param pressure constant, ≥ 0 [Pa]
  /// @param most     largest volume [m³]
  static GasLaw constant(double pressure, double most) { return {0, -pressure, most}; }
  /// @param pressure at `volume` above that outside, ≥ 0 [Pa]
  /// @param ambient  pressure outside, ≥ 0 [Pa]
  /// @param volume   positive [m³]
  static GasLaw ideal(double pressure, double ambient, double volume, double most) {
    return {(ambient + pressure) * volume, ambient, most};
  }

  /// Returns E(V) [J].
  [[nodiscard]] double energy(double volume) const;
  /// Returns p(V) [Pa].
  [[nodiscard]] double pressure(double volume) const { return (amount_ == 0 ? 0 : amount_ / volume) - outside_; }
  /// Returns −dp/dV = N/V² [Pa/m³].
  [[nodiscard]] double slope(double volume) const { return amount_ == 0 ? 0 : amount_ / (volume * volume); }

 private:
  GasLaw(double amount, double outside, double most);

  double amount_, outside_, most_, reference_;
};

/// Energy of the gas in closed pieces of a cloth, E = Σ E(V) with the volume V of each piece. Its gradient −p ∇V is
/// exact: every triangle pushes p/3 times its area vector at each corner. The forces of a piece have neither a sum nor
/// a moment, up to rounding.
///
/// The Hessian is N/V² ∇V∇Vᵀ − p ∇²V. ∇²V couples the ends i, j of an edge by a cross product: with the third vertices
/// k of the triangle (i, j, k) and l of (j, i, l) its block is ∇²Vᵢⱼ = [xₗ − xₖ]×/6. It is indefinite. A bound follows
/// from integrating by parts on the closed surface: for any displacement u and any centre o,
///   uᵀ∇²V u = Σ_triangles (x̄ − o)·(d₁ × d₂),   |d₁ × d₂| ≤ (|d₁|² + |d₂|² + |d₃|²)/(2√3),
/// where x̄ is a triangle's centroid and d are the differences of u along its sides. So −p ∇²V lies between −B and B, a
/// sum over edges with the stiffness p |x̄ − o|/√3 of each triangle at it, across x̄ − o. The Hessian without negative
/// eigenvalues is (B − p ∇²V)/2: positive semi-definite, not below −p ∇²V, and zero for translations.
class GasEnergy final : public Energy {
 public:
  /// @param laws one for each piece
  GasEnergy(const Cloth& cloth, std::span<const ClosedPiece> pieces, std::span<const GasLaw> laws);

  double add_gradient(const Vertices& x, double time, Vertices& gradient) const override;
  void add_bound(StiffnessBound& bound) const override;
  [[nodiscard]] std::unique_ptr<EnergyHessian> make_hessian() const override;

  /// Returns the volume of a piece [m³].
  [[nodiscard]] double volume(std::size_t piece, const Vertices& x) const {
    return enclosed_volume(pieces_[piece].triangles, x);
  }
  /// Returns the pressure in a piece above that outside [Pa].
  [[nodiscard]] double pressure(std::size_t piece, const Vertices& x) const {
    return pieces_[piece].law.pressure(volume(piece, x));
  }

  /// Returns the largest volume of a piece for which the bound of its Hessian holds: that of a ball with its surface,
  /// stretched by 3/2 in every direction [m³].
  static double largest_volume(const ClosedPiece& piece, const Cloth& cloth);

 private:
  class Hessian;

  /// An edge i < j with its two triangles, and their third vertices: k of (i, j, k) and l of (j, i, l).
  struct Side {
    int i, j, k, l;
  };
  struct Piece {
    std::vector<Triangle> triangles;
    std::vector<Side> sides;
    std::vector<int> vertices;                  // ascending
    std::vector<std::array<int, 3>> positions;  // corners of the triangles as indices of `vertices`
    GasLaw law;
    double stiffness;  // bound of each edge [N/m]
  };

  /// Returns a bound of the stiffness of every edge [N/m].
  [[nodiscard]] static double stiffness_bound(const Piece& piece, const Cloth& cloth);

  std::vector<Piece> pieces_;
};

}  // namespace drape
