#include "sim/schemes/safe_step_guard.hpp"

#include <fmt/format.h>

#include <cmath>

#include "sim/stability.hpp"

namespace drape {

SafeStepGuard::SafeStepGuard(const System& system) : step_(system.step), safe_step_(safe_step(system)) {
  // What pins and filters do to the cloth is no force. Beyond the safe step that does not count.
  if (step_ > safe_step_ || (system.pin_motions.empty() && system.filters.empty())) watch_.emplace(system, safe_step_);
}

std::optional<std::string> SafeStepGuard::problem() const {
  if (step_ <= safe_step_) return std::nullopt;
  return fmt::format(
      "{:g} s is too long for semi-implicit Euler: with these springs and masses it is stable up to {:.4g} s; take a "
      "shorter step or an implicit method, or set [integrator] allow_unstable = true to run it nevertheless",
      step_, safe_step_);
}

void SafeStepGuard::begin(const State& state, const EnergyNow& energy) {
  if (!watch_) return;
  watch_->begin(energy());
  looked_at_ = state.x;
  work_ = 0;
}

std::optional<double> SafeStepGuard::look(const State& state, const Vertices& push, bool constant,
                                          const EnergyNow& energy) {
  if (!watch_) return std::nullopt;
  if (!constant) work_ += step_ * std::abs(push.cwiseProduct(state.v).sum());
  if (state.step % watch_->interval() != 0) return std::nullopt;
  if (constant) work_ = std::abs(push.cwiseProduct(state.x - looked_at_).sum());
  const auto growth = watch_->look(work_, energy());
  looked_at_ = state.x;
  work_ = 0;
  return growth;
}

std::string SafeStepGuard::remedy() const {
  constexpr const char* others = "method = \"liu13\", \"implicit\" or \"quasi-newton\"";
  if (step_ <= safe_step_) {
    return fmt::format(
        ", though the step is below {:.4g} s, up to which semi-implicit Euler is stable as long as springs do not pass "
        "through zero length, where each gains a little: take a step far below it, or {}",
        safe_step_, others);
  }
  return fmt::format("; semi-implicit Euler is stable up to a step of {:.4g} s here: take a shorter one, or {}",
                     safe_step_, others);
}

}  // namespace drape
