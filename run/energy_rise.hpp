#pragma once

#include <optional>

#include "run/step_observer.hpp"
#include "sim/energies.hpp"

namespace drape {

/// Monitor of the total energy of a cloth that nothing feeds with energy. Contact that is corrected after a step, and
/// not solved in it, can create energy. The monitor does not change the motion.
class EnergyRise final : public StepObserver {
 public:
  void begin(const Simulation& simulation) override;
  void after_step(const Simulation& simulation, const StepReport& report, double seconds) override;
  /// Records a step of an earlier run, see StepObserver.
  void replay(const StepRow& row, double time, double seconds) override;

  /// The largest rise of the total energy above that at the start [J], and its share of the available energy. Available
  /// are the kinetic and elastic energy at the start, and the weight times the fall of the centre of mass. The
  /// potential of an obstacle's push is left out of both, which can only make them smaller.
  struct Rise {
    double energy, of_available;
    /// Returns true if the rise exceeds 1 % of the available energy, more than a step's tolerance explains.
    [[nodiscard]] bool notable() const { return of_available > 0.01; }
  };
  /// Returns the rise; nothing if the cloth touches nothing or gets energy from outside.
  [[nodiscard]] std::optional<Rise> rise() const;

 private:
  void note(const Energies& now);

  bool watches_ = false;
  std::optional<Energies> first_;    // energies at the start
  double available_ = 0, rise_ = 0;  // [J]
};

}  // namespace drape
