#include "sim/schemes/condition_guard.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sim/stability.hpp"

namespace drape {

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

}  // namespace drape
