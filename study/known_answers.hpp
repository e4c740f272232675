#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "study/validation.hpp"

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

/// Returns the rest position of a spring-mass oscillator with dry friction: each half swing is shorter by two.
/// Both distances are relative to the largest at which friction holds the mass.
/// @param start distance from which it is let go
double stick_slip_rest(double start);

/// Returns a pendulum's period relative to that of small swings: 1/agm(1, cos(θ/2)).
/// @param amplitude θ, below 180 [degrees]
double pendulum_period(double amplitude);

/// A value from another program for a known answer.
struct GivenAnswer {
  const ValidationProblem* problem = nullptr;
  const KnownAnswer* known = nullptr;
  double value = 0;

  [[nodiscard]] bool met() const;
};

/// Reads answers from a CSV file with the columns problem, quantity and value, or from an NPZ file. An NPZ file has a
/// motion of one problem, measured like drape's own; vertices are in the order of the case's mesh. Its arrays are
/// `times`, `positions` (times × vertices × 3, or vertices × 3 for the last state), and `velocities` if the measure
/// needs them.
/// @param problem of the NPZ file; may be empty for a case with one problem
/// @throws UsageError "file: message"
std::vector<GivenAnswer> read_answers(const ValidationCase& of, const std::filesystem::path& file,
                                      const std::string& problem);

}  // namespace drape
