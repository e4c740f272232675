#include "sim/schemes/stability_guard.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/stability.hpp"

namespace drape {

SafeStepGuard::SafeStepGuard(std::string_view scheme, const System& system)
    : scheme_(scheme), step_(system.step), safe_step_(safe_step(system)) {
  // Below the safe step energy can only grow slowly, and the check is cheap. The work of pins and filters is unknown;
  // beyond the safe step it is negligible.
  const double limit = BlowUpWatch::limit(step_ / safe_step_);
  if (step_ > safe_step_) {
    watch_.emplace(system, limit, 1);
  } else if (system.pin_motions.empty() && system.filters.empty()) {
    watch_.emplace(system, limit, 256);
  }
}

std::optional<std::string> SafeStepGuard::problem() const {
  if (step_ <= safe_step_) return std::nullopt;
  return fmt::format(
      "{:g} s is too long for {}: with these springs and masses it is stable up to {:.4g} s; use a shorter step or an "
      "implicit method, or set [integrator] allow_unstable = true to run it anyway",
      step_, scheme_, safe_step_);
}

void SafeStepGuard::begin(const State& state, double energy) {
  if (watch_) watch_->begin(state, energy);
}

std::optional<double> SafeStepGuard::check_step(const State& state, const Vertices& push, bool constant,
                                                const EnergyNow& energy) {
  return watch_ ? watch_->check_step(state, push, constant, energy) : std::nullopt;
}

void SafeStepGuard::restore(const EnergyMemory& memory) {
  if (watch_) watch_->restore(memory);
}

std::string SafeStepGuard::remedy() const {
  constexpr const char* others = "method = \"liu13\", \"implicit\" or \"quasi-newton\"";
  if (step_ <= safe_step_) {
    return fmt::format(
        ", although the step is below {:.4g} s, up to which {} is stable unless springs pass through zero length and "
        "gain energy: use a much shorter step, or {}",
        safe_step_, scheme_, others);
  }
  return fmt::format("; {} is stable up to a step of {:.4g} s here: use a shorter one, or {}", scheme_, safe_step_,
                     others);
}

ConditionGuard::ConditionGuard(const System& system)
    : step_(system.step), condition_(condition_bound(system)), longest_pushed_(safe_step_of_pushes(system)) {}

double ConditionGuard::longest_step() const {
  // Half the bound, as it is estimated for this step and its terms are rounded.
  return std::min(longest_pushed_, step_ * std::sqrt(largest_condition / condition_ / 2));
}

std::optional<std::string> ConditionGuard::problem() const {
  if (condition_ <= largest_condition) return std::nullopt;
  const bool finite = std::isfinite(condition_);
  const std::string times = finite ? fmt::format("{:.2g}", condition_) : "more than 1e308";
  const std::string shorter =
      finite ? fmt::format("a step of at most {:.2g} s, ", step_ * std::sqrt(largest_condition / condition_)) : "";
  return fmt::format(
      "with a step of {:g} s the springs hold a vertex {} times as strongly as its inertia does; beyond {:.0e} double "
      "precision leaves only rounding noise: use {}softer springs or more mass, or set [integrator] allow_unstable = "
      "true to run it anyway",
      step_, times, largest_condition, shorter);
}

SubstepGuard::SubstepGuard(std::unique_ptr<StabilityGuard> guard, double step)
    : guard_(std::move(guard)), step_(step) {}

std::int64_t SubstepGuard::fewest_substeps(double step, double longest) {
  return static_cast<std::int64_t>(std::clamp<double>(std::ceil(step / longest), 1, most_substeps));
}

std::optional<std::string> SubstepGuard::problem() const {
  if (step_ <= most_substeps * longest_step()) return std::nullopt;
  return "too long even in 2^20 substeps: " + guard_->problem().value_or("pushes are too stiff even then");
}

}  // namespace drape
