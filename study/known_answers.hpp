#pragma once

#include <string>
#include <vector>

namespace drape {

/// The theoretical curve of a case.
struct KnownCurve {
  double (*value)(double x) = nullptr;  ///< null: the case has no formula
  bool continuous = true;               ///< false: x may only be 1, 2, 3 …
};

/// Returns the formula of a case's curve.
/// @param name "heavy-cantilever", @param curve "drop"
KnownCurve known_curve(const std::string& name, const std::string& curve);

/// Returns the k-th positive zero of the Bessel function J0, to rounding; k ≥ 1.
double bessel_zero(int k);

/// Returns the longest end of a strap that friction holds over half a roller, with the strap's weight on it [m].
/// @param light  length of the other end [m]
/// @param radius of the strap on the roller [m]
double capstan_limit(double friction, double light, double radius);

/// Returns the sag of an inextensible chain of 2 m between two points of equal height [m].
/// @param span distance of the points, between 0 and 2 [m]
double catenary_sag(double span);

/// Returns where a mass on a spring that swings on dry ground comes to rest: every half swing is shorter by two.
/// Both distances are relative to the largest at which friction holds the mass.
/// @param start distance from which it is let go
double stick_slip_rest(double start);

/// Returns a pendulum's period relative to that of small swings: 1/agm(1, cos(θ/2)).
/// @param amplitude θ, below 180 [degrees]
double pendulum_period(double amplitude);

}  // namespace drape
