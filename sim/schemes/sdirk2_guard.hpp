#pragma once

#include "sim/blow_up.hpp"
#include "sim/schemes/condition_guard.hpp"

namespace drape {

/// Guard for SDIRK2, which shares the limits of backward Euler but may gain energy. In tests with steps up to 46 ms and
/// tight solves, a motion never exceeded 1.6 times its initial and supplied energy. Even that occurred only if it
/// started crumpled into a line or a point. But a stiff cloth that crumples within a step of 0.1 s reached 38 times.
/// Also, an error δ of a loose solve puts k δ² into a spring, and the second stage starts with five times the error.
/// Beyond ten times the explained energy the motion is not physical.
class Sdirk2Guard final : public StabilityGuard {
 public:
  static constexpr double limit = 10;

  explicit Sdirk2Guard(const System& system);

  [[nodiscard]] std::optional<std::string> problem() const override { return condition_.problem(); }
  [[nodiscard]] double longest_step() const override { return condition_.longest_step(); }
  void begin(const State& state, const EnergyNow& energy) override;
  std::optional<double> look(const State& state, const Vertices& push, bool constant, const EnergyNow& energy) override;
  [[nodiscard]] std::optional<BlowUpWatch::EnergyHistory> books() const override;
  void go_on(const BlowUpWatch::EnergyHistory& books) override;
  [[nodiscard]] std::string remedy() const override;

 private:
  ConditionGuard condition_;
  std::optional<BlowUpWatch> watch_;  // if only forces give the cloth energy
};

}  // namespace drape
