#include "sim/schemes/substep_guard.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace drape {

SubstepGuard::SubstepGuard(std::unique_ptr<StabilityGuard> guard, double step)
    : guard_(std::move(guard)), step_(step) {}

int SubstepGuard::fewest_halvings(double step, double longest) {
  return static_cast<int>(std::clamp<double>(std::ceil(std::log2(step / longest)), 0, most_halvings));
}

std::optional<std::string> SubstepGuard::problem() const {
  if (step_ <= std::ldexp(longest_step(), most_halvings)) return std::nullopt;
  return "too long even in 2^20 substeps: " + guard_->problem().value_or("pushes are too stiff even then");
}

}  // namespace drape
