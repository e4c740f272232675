#pragma once

#include <string_view>

#include "sim/blow_up.hpp"
#include "sim/schemes/stability_guard.hpp"

namespace drape {

/// Guard for schemes that are stable up to safe_step() and may gain energy beyond it.
class SafeStepGuard final : public StabilityGuard {
 public:
  /// Computes the safe step, which takes a while for a large cloth.
  /// @param scheme name of the scheme in messages
  SafeStepGuard(std::string_view scheme, const System& system);

  [[nodiscard]] std::optional<std::string> problem() const override;
  [[nodiscard]] double longest_step() const override { return safe_step_; }
  void begin(const State& state, const EnergyNow& energy) override;
  std::optional<double> look(const State& state, const Vertices& push, bool constant, const EnergyNow& energy) override;
  [[nodiscard]] std::optional<BlowUpWatch::EnergyHistory> books() const override;
  void go_on(const BlowUpWatch::EnergyHistory& books) override;
  [[nodiscard]] std::string remedy() const override;

 private:
  std::string_view scheme_;
  double step_, safe_step_;           // [s]
  std::optional<BlowUpWatch> watch_;  // if energy is meaningful for this motion
};

}  // namespace drape
