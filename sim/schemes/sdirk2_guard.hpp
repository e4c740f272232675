#pragma once

#include "sim/blow_up.hpp"
#include "sim/schemes/condition_guard.hpp"

namespace drape {

/// For SDIRK2, which can be computed as far as backward Euler, but promises nothing about energy. Measured, with steps
/// up to 46 ms a motion whose stages are solved tightly never has more than 1.6 times what the cloth had and was given,
/// and that only where it starts crumpled into a line or a point. But where a stiff cloth crumples within a step of 0.1
/// s it has had 38 times that, and an error δ of a loose solve puts k δ² into a spring, while the second stage begins
/// where it is five times as large. Beyond ten times what is explained it is no motion of this cloth.
class Sdirk2Guard final : public StabilityGuard {
 public:
  static constexpr double limit = 10;

  explicit Sdirk2Guard(const System& system);

  [[nodiscard]] std::optional<std::string> problem() const override { return condition_.problem(); }
  [[nodiscard]] double longest_step() const override { return condition_.longest_step(); }
  void begin(const State& state, const EnergyNow& energy) override;
  std::optional<double> look(const State& state, const Vertices& push, bool constant, const EnergyNow& energy) override;
  [[nodiscard]] std::optional<BlowUpWatch::Books> books() const override;
  void go_on(const BlowUpWatch::Books& books) override;
  [[nodiscard]] std::string remedy() const override;

 private:
  ConditionGuard condition_;
  std::optional<BlowUpWatch> watch_;  // where nothing gives the cloth energy but forces
};

}  // namespace drape
