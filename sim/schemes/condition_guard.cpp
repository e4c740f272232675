#include "sim/schemes/condition_guard.hpp"

#include <fmt/format.h>

#include <cmath>

#include "sim/stability.hpp"

namespace drape {

ConditionGuard::ConditionGuard(const System& system) : step_(system.step), condition_(condition_bound(system)) {}

std::optional<std::string> ConditionGuard::problem() const {
  if (condition_ <= largest_condition) return std::nullopt;
  return fmt::format(
      "with a step of {:g} s the springs hold a vertex {:.2g} times as fast as its inertia, and double precision keeps "
      "{:.0e} apart: beyond that the motion is rounding; take a step of at most {:.2g} s, softer springs or more mass, "
      "or set [integrator] allow_unstable = true to run it nevertheless",
      step_, condition_, largest_condition, step_ * std::sqrt(largest_condition / condition_));
}

}  // namespace drape
