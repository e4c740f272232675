#pragma once

#include <vector>

#include "sim/collision/candidates.hpp"

namespace drape {

/// Velocities of vertices, which contacts change by impulses.
struct MovingVertices {
  std::vector<Point> velocities;       ///< [m/s]
  std::vector<double> inverse_masses;  ///< 0 for a pin [1/kg]

  [[nodiscard]] Point velocity(int i) const { return velocities[static_cast<std::size_t>(i)]; }
  [[nodiscard]] double inverse_mass(int i) const { return inverse_masses[static_cast<std::size_t>(i)]; }
};

/// Two features that touch: Σ weights·v of their four vertices is how fast the first leaves the second. An impulse J
/// gives weights[i]·J to vertex i: as the weights sum to zero, it changes no momentum.
struct Contact {
  std::array<int, 4> vertices;
  std::array<double, 4> weights;
  Point normal;        ///< from the second to the first
  double least_speed;  ///< with which they have to part, along the normal; negative where they may come nearer [m/s]
  double inverse_mass = 0;         ///< Σ weights²/m [1/kg]
  double impulse = 0;              ///< along the normal so far [N·s]
  Point friction = Point::Zero();  ///< across it so far [N·s]

  /// @param difference Σ weights·x, not zero
  Contact(const FeaturePair& pair, const std::array<double, 4>& w, const Point& difference, double speed,
          const MovingVertices& vertices);

  /// Changes the velocities so that the features part fast enough, and lets friction (Coulomb's, up to `coefficient`
  /// times the impulse) stop them from sliding. Impulses are summed up and never pull: called again for all contacts in
  /// turn, this is projected Gauss-Seidel.
  void apply(double coefficient, MovingVertices& vertices);
};

}  // namespace drape
