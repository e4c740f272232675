#include "study/local_error.hpp"

#include <cmath>

#include "study/reference.hpp"

namespace drape {
namespace {

constexpr int explicit_halvings = 9, implicit_halvings = 7;

}  // namespace

LocalErrors::LocalErrors(const SimulationSettings& settings) {
  SimulationSettings small = settings;
  small.accuracy.reset();
  small.integrator = {};
  small.integrator.method = Method::verlet;
  halvings_ = explicit_halvings;
  try {
    make(small, settings.step);
  } catch (const UsageError&) {
    halvings_ = implicit_halvings;
    small.integrator.scheme = TimeScheme::sdirk2;
    small.step = std::ldexp(settings.step, -halvings_);
    make(to_rounding(small, Method::quasi_newton), settings.step);
  }
}

void LocalErrors::make(SimulationSettings small, double step) {
  small.step = std::ldexp(step, 1 - halvings_);
  twice_.emplace(small);
  small.step = std::ldexp(step, -halvings_);
  small_.emplace(small);
}

Vertices LocalErrors::small_steps(Simulation& simulation, int halvings, State from) {
  from.step <<= halvings;
  const std::int64_t end = from.step + (std::int64_t{1} << halvings);
  simulation.restore(from);
  while (simulation.state().step < end) simulation.step();
  return simulation.state().x;
}

std::optional<LocalErrors::LocalError> LocalErrors::of_step(const State& before, const Vertices& after) {
  try {
    const Vertices plain = small_steps(*small_, halvings_, before),
                   coarse = small_steps(*twice_, halvings_ - 1, before);
    const Vertices exact = (4 * plain - coarse) / 3;
    return LocalError{distance(after, exact).max, distance(plain, exact).max};
  } catch (const DivergedError&) {
    return std::nullopt;
  }
}

}  // namespace drape
