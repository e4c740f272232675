#pragma once

#include <string>
#include <vector>

namespace drape {

/// A case's curve as theory has it.
struct KnownCurve {
  double (*value)(double x) = nullptr;  ///< null: the case has no formula
  bool continuous = true;               ///< x may be any number, not only 1, 2, 3 …
};

/// The formula of a case's curve.
/// @param name "heavy-cantilever", @param curve "drop"
KnownCurve known_curve(const std::string& name, const std::string& curve);

/// The k-th positive zero of the Bessel function J0, k from 1 on, to rounding.
double bessel_zero(int k);

/// The longest end of a strap that friction holds over half of a roller, the strap's weight on the roller included [m].
/// @param light  length of the other end [m]
/// @param radius of the strap on the roller [m]
double capstan_limit(double friction, double light, double radius);

/// The sag of an inextensible chain of 2 m between two points at one height [m].
/// @param span from point to point, between 0 and 2 [m]
double catenary_sag(double span);

/// The place where a mass on a spring rests that is let go on dry ground: every half swing is shorter by two.
/// @param start from where, over the largest distance at which friction holds it
double stick_slip_rest(double start);

/// A pendulum's period over that of small swings: 1/agm(1, cos(θ/2)).
/// @param amplitude θ, below 180 [degrees]
double pendulum_period(double amplitude);

}  // namespace drape
