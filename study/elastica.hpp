#pragma once

namespace drape {

/// The position of a heavy elastica's tip, relative to its length.
struct ElasticaTip {
  double drop = 0, reach = 0;  ///< depth below the clamp, and horizontal distance from it

  /// Returns the angle of the chord from clamp to tip below the horizontal [degrees].
  [[nodiscard]] double chord_angle() const;
};

/// Computes a strip of unit length, clamped horizontally at one end, inextensible, bent by its own weight:
///    θ″ = −Γ (1 − s) cos θ,  θ(0) = 0,  θ′(1) = 0,
/// with the angle θ below the horizontal and Γ = ρ g L³/D. Shooting from the free end with classical Runge–Kutta; the
/// tip's position is accurate to 1e-10.
/// @param gamma Γ, from 0 to 1000
ElasticaTip heavy_elastica(double gamma);

}  // namespace drape
