#pragma once

#include "sim/blow_up.hpp"
#include "sim/schemes/stability_guard.hpp"

namespace drape {

/// For schemes that are stable up to a step of their own, safe_step(), and may gain energy beyond it.
class SafeStepGuard final : public StabilityGuard {
 public:
  /// Finds the safe step, which takes a while for a large cloth.
  explicit SafeStepGuard(const System& system);

  [[nodiscard]] std::optional<std::string> problem() const override;
  void begin(const State& state, const EnergyNow& energy) override;
  std::optional<double> look(const State& state, const Vertices& push, bool constant, const EnergyNow& energy) override;
  [[nodiscard]] std::string remedy() const override;

 private:
  double step_, safe_step_;           // [s]
  std::optional<BlowUpWatch> watch_;  // where it makes sense to keep the books
  Vertices looked_at_;                // where the cloth was when it last looked
  double work_ = 0;                   // since then [J]
};

}  // namespace drape
