#include "check/rounding.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "sim/effects/self_collision.hpp"
#include "sim/effects/strain_limit.hpp"

namespace drape {
namespace {

constexpr int position_bits = 29;        // bits below the largest coordinate of the cloth at rest
constexpr double compared_part = 0.1;    // share of the tolerance
constexpr int smallest_exponent = -900;  // exponent limit of all quanta, so that their multiples are normal numbers

constexpr double largest_multiple = 0x1p52;

// The constraints of these effects may hold by less than a rounding error.
constexpr std::array<std::string_view, 2> exact_effects{SelfCollision::name, StrainLimit::name};

/// Returns the largest power of two up to a number.
double power_below(double number) { return std::exp2(std::max(std::ilogb(number), smallest_exponent)); }

double nearest(double value, double quantum) {
  const double multiple = std::nearbyint(value / quantum);
  return std::abs(multiple) < largest_multiple ? multiple * quantum : value;  // larger values are multiples already
}

}  // namespace

RoundingUnits quanta_for(const SimulationSettings& settings, double motion_tolerance) {
  RoundingUnits quanta;
  quanta.compared = power_below(std::max(compared_part * motion_tolerance, least_quantum));
  const bool exact = std::any_of(settings.effects.begin(), settings.effects.end(), [](const Effect& effect) {
    return std::find(exact_effects.begin(), exact_effects.end(), effect.name()) != exact_effects.end();
  });
  if (exact) return quanta;
  const double extent = settings.cloth.positions.size() == 0 ? 1 : settings.cloth.positions.cwiseAbs().maxCoeff();
  const double fine = power_below(std::max(extent, 1e-200) * std::exp2(1 - position_bits));
  quanta.position = std::min(fine, quanta.compared);
  quanta.velocity = RoundingUnits::velocity_factor * quanta.position;
  return quanta;
}

Vertices rounded(const Vertices& values, double quantum, const std::vector<int>& exact_rows) {
  if (quantum == 0) return values;
  Vertices result = values.unaryExpr([quantum](double value) { return nearest(value, quantum); });
  for (const int row : exact_rows) result.row(row) = values.row(row);
  return result;
}

std::vector<double> rounded(std::vector<double> numbers, double quantum) {
  for (double& number : numbers) number = nearest(number, quantum);
  return numbers;
}

State rounded(const State& state, const std::vector<int>& pins, const RoundingUnits& quanta) {
  return {
      .x = rounded(state.x, quanta.position, pins), .v = rounded(state.v, quanta.velocity, pins), .step = state.step};
}

}  // namespace drape
