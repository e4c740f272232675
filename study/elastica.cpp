#include "study/elastica.hpp"

#include <array>
#include <cmath>
#include <numbers>

namespace drape {
namespace {

constexpr int elastica_steps = 4000;

/// θ, dθ/dσ, drop and reach, with σ = 1 − s measured from the free end.
using ElasticaState = std::array<double, 4>;

ElasticaState slope_of(const ElasticaState& y, double sigma, double gamma) {
  return {y[1], -gamma * sigma * std::cos(y[0]), std::sin(y[0]), std::cos(y[0])};
}

ElasticaState moved(const ElasticaState& y, const ElasticaState& slope, double way) {
  ElasticaState result = y;
  for (std::size_t k = 0; k < y.size(); ++k) result[k] += way * slope[k];
  return result;
}

/// Returns the state at the clamp for the angle `tip` at the free end.
ElasticaState shoot(double tip, double gamma) {
  constexpr double h = 1.0 / elastica_steps;
  ElasticaState y{tip, 0, 0, 0};
  for (int step = 0; step < elastica_steps; ++step) {
    const double sigma = step * h;
    const ElasticaState k1 = slope_of(y, sigma, gamma), k2 = slope_of(moved(y, k1, h / 2), sigma + h / 2, gamma),
                        k3 = slope_of(moved(y, k2, h / 2), sigma + h / 2, gamma),
                        k4 = slope_of(moved(y, k3, h), sigma + h, gamma);
    for (std::size_t k = 0; k < y.size(); ++k) y[k] += h / 6 * (k1[k] + 2 * k2[k] + 2 * k3[k] + k4[k]);
  }
  return y;
}

/// Returns the angle at the free end of the hanging equilibrium: the largest angle with a horizontal clamp.
double tip_angle(double gamma) {
  constexpr int scanned = 200;
  double high = std::numbers::pi / 2, above = shoot(high, gamma)[0], low = high, below = above;
  for (int i = 1; i <= scanned && below > 0; ++i) {
    high = low;
    above = below;
    low = std::numbers::pi / 2 * (1 - static_cast<double>(i) / scanned);
    below = shoot(low, gamma)[0];
  }
  // The Illinois variant of regula falsi.
  for (int i = 0; i < 100 && high - low > 1e-16; ++i) {
    const double middle = (low * above - high * below) / (above - below), value = shoot(middle, gamma)[0];
    if (std::abs(value) < 1e-15) return middle;
    if (value > 0) {
      high = middle;
      above = value;
      below /= 2;
    } else {
      low = middle;
      below = value;
      above /= 2;
    }
  }
  return (low + high) / 2;
}

}  // namespace

double ElasticaTip::chord_angle() const { return std::atan2(drop, reach) * 180 / std::numbers::pi; }

ElasticaTip heavy_elastica(double gamma) {
  if (gamma <= 0) return {0, 1};
  const ElasticaState clamp = shoot(tip_angle(gamma), gamma);
  return {clamp[2], clamp[3]};
}

}  // namespace drape
