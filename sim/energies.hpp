#pragma once

// Example:
//   const drape::Energies now{.kinetic = 2, .gravity = -3, .elastic = 0.5};
//   const double all = now.total();  // -0.5 J

namespace drape {

/// The energies of a cloth at one moment [J].
struct Energies {
  double kinetic = 0;  ///< Σ m v²/2
  double gravity = 0;  ///< −Σ m g·x
  double elastic = 0;  ///< of all springs and of bending

  [[nodiscard]] double total() const { return kinetic + gravity + elastic; }
};

}  // namespace drape
