#include "sim/schemes/safe_step_guard.hpp"

#include <fmt/format.h>

#include <cmath>

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

void SafeStepGuard::begin(const State& state, const EnergyNow& energy) {
  if (watch_) watch_->begin(state, energy());
}

std::optional<double> SafeStepGuard::look(const State& state, const Vertices& push, bool constant,
                                          const EnergyNow& energy) {
  return watch_ ? watch_->look(state, push, constant, energy) : std::nullopt;
}

std::optional<BlowUpWatch::EnergyHistory> SafeStepGuard::books() const {
  return watch_ ? std::optional(watch_->books()) : std::nullopt;
}

void SafeStepGuard::go_on(const BlowUpWatch::EnergyHistory& books) {
  if (watch_) watch_->go_on(books);
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

}  // namespace drape
