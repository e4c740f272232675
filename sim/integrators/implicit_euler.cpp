#include "sim/integrators/implicit_euler.hpp"

#include <utility>

namespace drape {
namespace {

constexpr double sufficient_decrease = 1e-4;  // Armijo's constant, as usual (Nocedal and Wright 2006, section 3.1)
constexpr double smallest_length = 1e-10;

}  // namespace

ImplicitEuler::ImplicitEuler(const System& system, const IntegratorSettings& settings, int default_max_iterations)
    : system_(system),
      stop_(settings.stop),
      tolerance_(settings.tolerance),
      max_iterations_(settings.max_iterations.value_or(default_max_iterations)),
      objective_(system),
      point_{.x = system.cloth.positions, .gradient = Vertices::Zero(system.cloth.vertex_count(), 3)},
      trial_(point_) {}

StepReport ImplicitEuler::advance(State& state, const Vertices& force) {
  objective_.begin(state, force);
  point_.x = objective_.y();
  point_.value = objective_.evaluate(point_.x, point_.gradient);
  start();
  const StepReport report = minimise();
  state.v = (point_.x - state.x) / system_.step;
  if (system_.filters.empty()) {
    state.x = point_.x;
  } else {
    system_.filter(state);
    state.x += system_.step * state.v;
    system_.place_pins(state, state.x);
  }
  system_.correct(state);
  system_.drive_pins(state);
  return report;
}

StepReport ImplicitEuler::minimise() {
  const auto balanced = [this] { return stop_ == StoppingRule::gradient && residual() < tolerance_; };
  for (int iteration = 1; iteration <= max_iterations_; ++iteration) {
    if (balanced()) return {iteration - 1, true};
    const double change = iterate(point_);
    if (stop_ == StoppingRule::change && iteration >= 2 && change < tolerance_) return {iteration, true};
  }
  return {max_iterations_, balanced()};
}

double ImplicitEuler::descend(Point& point, const Vertices& direction, double slope) {
  const auto count = static_cast<std::size_t>(point.x.size());
  for (double length = 1; length >= smallest_length; length /= 2) {
    trial_.x = point.x;
    kernels().add_multiple(count, -length, direction.data(), trial_.x.data());
    trial_.value = objective_.evaluate(trial_.x, trial_.gradient);
    // Near the minimum g changes by less than it can be computed to; the direction is trusted there.
    const double highest = point.value - sufficient_decrease * length * slope + objective_.rounding(point.value);
    if (trial_.value <= highest) {
      std::swap(point, trial_);
      return length;
    }
  }
  return 0;
}

double ImplicitEuler::residual() { return norm(point_.gradient); }

}  // namespace drape
