#pragma once

// Example:
//   drape::Effects effects{drape::Bending{.rigidity = drape::WarpWeft(4e-5, 1e-5)}};
//   drape::Effects same{drape::Bending{.rigidity = 2e-5}};  // in all directions

namespace drape {

/// A property of a woven cloth along its warp, and along its weft across it.
struct WarpWeft {
  double warp = 0, weft = 0;
  double angle = 0;  ///< angle of the warp in the rest shape, from the x axis towards y [rad]

  constexpr WarpWeft() = default;
  // Implicit, so that a number is a property equal in all directions.
  constexpr WarpWeft(double both) : warp(both), weft(both) {}
  constexpr WarpWeft(double along_warp, double along_weft, double warp_angle = 0)
      : warp(along_warp), weft(along_weft), angle(warp_angle) {}
  bool operator==(const WarpWeft&) const = default;

  /// Returns true if all directions are alike.
  [[nodiscard]] constexpr bool isotropic() const { return warp == weft; }
};

}  // namespace drape
