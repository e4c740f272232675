#pragma once

#include <optional>

#include "drape/core/warp_weft.hpp"
#include "drape/sim/cloth.hpp"

namespace drape {

/// Returns the angle from the first side of a triangle of the rest shape to the warp, counterclockwise as seen from the
/// triangle's front [rad]. The warp lies in the triangle's plane above or below the direction (cos, sin, 0). Nothing if
/// the triangle has no area or is perpendicular to that.
/// @param angle of the direction, see WarpWeft [rad]
std::optional<double> warp_angle(const Cloth& cloth, const Triangle& triangle, double angle);

/// Gives every spring the stiffness F(θ)·A/l², with rest length l, area A of the rest triangles at it, and angle θ from
/// the warp. F is chosen such that a sheet has the modulus E₁ along the warp and E₂ along the weft.
///
/// Springs with Σ k l² n⊗n⊗n⊗n = C per area store ½ ε:C:ε under a uniform strain. C has all symmetries, so the
/// stiffness in shear C₁₂₁₂ is C₁₁₂₂. The C of this cloth is C₁₁₁₁ = 9/8 E₁, C₂₂₂₂ = 9/8 E₂, C₁₁₂₂ = 3/8 √(E₁E₂): the
/// orthotropic sheet of Huber 1923 with the Poisson's ratios √(E₁/E₂)/3 and √(E₂/E₁)/3. Pulled at an angle θ from the
/// warp it has 1/√E(θ) = cos²θ/√E₁ + sin²θ/√E₂. For E₁ = E₂ that is the isotropic sheet of stiffen_evenly().
///
/// F(θ) = a₀ + a₁ cos 2θ + b₁ sin 2θ + a₂ cos 4θ + b₂ sin 4θ has as many coefficients as C has numbers. If springs have
/// all directions equally, F(θ) = 3/8 (E₁ + E₂) + ¼ √(E₁E₂) + ¾ (E₁ − E₂) cos 2θ + ¾ (√E₁ − √E₂)² cos 4θ, which is
/// positive if neither modulus is nine times the other. Springs in few directions, as in a grid with one diagonal, have
/// no such C.
/// @param modulus E₁, E₂, force per width and strain, positive [N/m]
/// @throws std::invalid_argument with a sentence, if the mesh's edges cannot have this C, or a spring would push
void stiffen_as_woven(const WarpWeft& modulus, Cloth& cloth);

/// Gives every spring the stiffness E(θ)·A/l² with the E(θ) of stiffen_as_woven(), or √(E₁E₂) if the warp has no
/// direction there. It fits every mesh, as stiffen_by_area() does. A grid with one diagonal has E₁ and E₂ along its
/// sides while shear is free; between the directions of its edges a mesh with few of them deviates.
/// @throws std::invalid_argument if a spring has no triangle with an area
void stiffen_by_direction(const WarpWeft& modulus, Cloth& cloth);

}  // namespace drape
