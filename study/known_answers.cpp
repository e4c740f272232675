#include "study/known_answers.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "study/elastica.hpp"

namespace drape {
namespace {

using std::numbers::pi;

/// Returns the fall of a flat sheet from rest, in units of v∞²/g, at a time in units of v∞/g.
double fallen(double time) { return std::log(std::cosh(time)); }

/// Returns the acceleration on a slope of tangent x with friction 0.3, relative to g.
double sliding(double tangent) {
  constexpr double friction = 0.3;
  return std::max(0.0, (tangent - friction) / std::hypot(1, tangent));
}

/// Returns the way of a sheet that a steadily moving spring pulls over dry ground, relative to the way of the spring's
/// end in a cycle.
/// @param cycles since the spring first exceeded friction
double stick_slip_way(double cycles) { return cycles < 0 ? 0 : cycles - std::sin(2 * pi * cycles) / (2 * pi); }

/// Returns the modulus relative to E at an angle [degrees], from weights of springs along 0° and 90°, 45°, and 135°.
double modulus_at(double angle, double sides, double rising, double falling) {
  const auto share = [angle](double spring) { return std::pow(std::cos((angle - spring) * pi / 180), 4); };
  return sides * (share(0) + share(90)) + rising * share(45) + falling * share(135);
}

/// Returns the modulus relative to E of an isotropic sheet with Poisson's ratio 1/3. The four loads are strain in one
/// direction, in the other, equal strains in both, and opposite strains.
double isotropic_modulus(double load) {
  constexpr std::array values{9.0 / 8, 9.0 / 8, 3.0, 1.5};
  return values.at(static_cast<std::size_t>(std::lround(load) - 1));
}

const std::map<std::string, KnownCurve>& all_known_curves() {
  static const std::map<std::string, KnownCurve> curves{
      {"heavy-cantilever/drop", {[](double gamma) { return heavy_elastica(gamma).drop; }}},
      {"heavy-cantilever/reach", {[](double gamma) { return heavy_elastica(gamma).reach; }}},
      {"bending-length/angle", {[](double gamma) { return heavy_elastica(gamma).chord_angle(); }}},
      {"catenary/sag", {catenary_sag}},
      {"pendulum/period", {pendulum_period}},
      {"hanging-chain/frequency", {[](double n) { return bessel_zero(static_cast<int>(std::lround(n))) / 2; }, false}},
      {"membrane/frequency", {[](double waves) { return waves; }}},
      {"terminal-velocity/fallen", {fallen}},
      {"incline/acceleration", {sliding}},
      {"capstan/slipped", {[](double load) { return load > 1 ? 1.0 : 0.0; }}},
      {"turntable/slipped", {[](double load) { return load > 1 ? 1.0 : 0.0; }}},
      {"stick-slip/way", {stick_slip_way}},
      {"stick-slip/rest", {stick_slip_rest}},
      {"restitution/rebound", {[](double e) { return e * e; }}},
      {"pattern-stiffness/diagonal", {[](double angle) { return modulus_at(angle, 1, 0, 1); }}},
      {"pattern-stiffness/alternating", {[](double angle) { return modulus_at(angle, 1, 0.5, 0.5); }}},
      {"pattern-stiffness/x", {[](double angle) { return modulus_at(angle, 0.5, 1, 1); }}},
      {"pattern-stiffness/grid", {isotropic_modulus, false}},
      {"lateral-buckling/buckled", {[](double gamma) { return gamma > 12.85 * std::numbers::sqrt2 ? 1.0 : 0.0; }}},
      {"clamped-plate/frequency", {[](double) { return 35.985; }, false}},
      {"rolled-sheet/energy", {[](double) { return 1.0; }}},
      {"free-flight/ratio", {[](double) { return 1.0; }, false}},
  };
  return curves;
}

}  // namespace

KnownCurve known_curve(const std::string& name, const std::string& curve) {
  const auto found = all_known_curves().find(name + "/" + curve);
  return found == all_known_curves().end() ? KnownCurve{} : found->second;
}

double bessel_zero(int k) {
  const double b = (k - 0.25) * pi;
  double x = b + 1 / (8 * b);  // McMahon's expansion
  for (int i = 0; i < 20; ++i) x += std::cyl_bessel_j(0, x) / std::cyl_bessel_j(1, x);
  return x;
}

double capstan_limit(double friction, double light, double radius) {
  // T/(ρgR) = C e^{µθ} + a cos θ + b sin θ; the b term vanishes at both ends.
  const double a = -2 * friction / (1 + friction * friction);
  return ((light / radius - a) * std::exp(friction * pi) - a) * radius;
}

double catenary_sag(double span) {
  // a sinh(x/a) = 1 with x half the span: u = x/a solves sinh(u)/u = 1/x.
  const double half = span / 2;
  double low = 1e-9, high = 50;
  for (int i = 0; i < 200; ++i) {
    const double u = (low + high) / 2;
    (half * std::sinh(u) > u ? high : low) = u;
  }
  const double a = half / low;
  return a * (std::cosh(low) - 1);
}

double stick_slip_rest(double start) {
  return std::abs(start) <= 1 ? start : -stick_slip_rest(start - std::copysign(2, start));
}

double pendulum_period(double amplitude) {
  double a = 1, b = std::cos(amplitude * pi / 360);
  for (int i = 0; i < 60 && std::abs(a - b) > 1e-16; ++i) {
    const double mean = (a + b) / 2;
    b = std::sqrt(a * b);
    a = mean;
  }
  return 1 / a;
}

}  // namespace drape
