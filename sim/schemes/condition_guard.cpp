#include "sim/schemes/condition_guard.hpp"

#include <fmt/format.h>

#include <cmath>

#include "sim/stability.hpp"

namespace drape {

ConditionGuard::ConditionGuard(const System& system) : step_(system.step), condition_(condition_bound(system)) {}

std::optional<std::string> ConditionGuard::problem() const {
  if (condition_ <= largest_condition) return std::nullopt;
  const bool finite = std::isfinite(condition_);
  const std::string times = finite ? fmt::format("{:.2g}", condition_) : "more than 1e308";
  const std::string shorter =
      finite ? fmt::format("a step of at most {:.2g} s, ", step_ * std::sqrt(largest_condition / condition_)) : "";
  return fmt::format(
      "with a step of {:g} s the springs hold a vertex {} times as fast as its inertia, and double precision keeps "
      "{:.0e} apart: beyond that the motion is rounding; take {}softer springs or more mass, "
      "or set [integrator] allow_unstable = true to run it nevertheless",
      step_, times, largest_condition, shorter);
}

}  // namespace drape
