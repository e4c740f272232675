#pragma once

namespace drape {

/// The place of the tip of a heavy elastica, in its lengths.
struct ElasticaTip {
  double drop = 0, reach = 0;  ///< below the clamp, and from it

  /// Of the straight line from the clamp to the tip, below the horizontal [degrees].
  [[nodiscard]] double chord_angle() const;
};

/// A strip of unit length, clamped level at one end, that bends under its own weight and does not stretch:
///   θ″ = −Γ (1 − s) cos θ,  θ(0) = 0,  θ′(1) = 0,
/// θ its angle below the horizontal and Γ = ρ g L³/D. Solved by shooting from the free end with classical
/// Runge–Kutta; the tip's place is known to 1e-10.
/// @param gamma Γ, from 0 to 1000
ElasticaTip heavy_elastica(double gamma);

}  // namespace drape
