#pragma once

#include <optional>

#include "run/step_observer.hpp"
#include "sim/energies.hpp"

namespace drape {

/// How far the total energy of a cloth rose that nothing gives any. What touches it can make energy out of nothing
/// where it is laid over a step instead of solved in it. It changes nothing of the motion.
class EnergyRise final : public StepObserver {
 public:
  void begin(const Simulation& simulation) override;
  void after_step(const Simulation& simulation, const StepReport& report, double seconds) override;
  /// A step that was done before, see StepObserver.
  void replay(const StepRow& row, double time, double seconds) override;

  /// How far it rose at most above that of the start [J], and what part that is of all that the cloth ever had: its
  /// kinetic and elastic energy at the start, and its weight times how far its centre of mass fell. What the push of an
  /// obstacle stores is in neither, so that it is too little rather than too much.
  struct Rise {
    double energy, of_available;
    /// Whether it is more than the tolerance of a step explains.
    [[nodiscard]] bool notable() const { return of_available > 0.01; }
  };
  /// Nothing where something gives the cloth energy, or it touches nothing.
  [[nodiscard]] std::optional<Rise> rise() const;

 private:
  void note(const Energies& now);

  bool watches_ = false;
  std::optional<Energies> first_;    // at the start
  double available_ = 0, rise_ = 0;  // [J]
};

}  // namespace drape
