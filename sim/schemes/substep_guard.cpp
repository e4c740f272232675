#include "sim/schemes/substep_guard.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace drape {

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
