#pragma once

#include <functional>
#include <optional>
#include <string>

#include "sim/blow_up.hpp"
#include "sim/system.hpp"

namespace drape {

/// Guard against motions that a scheme cannot compute. It rejects them beforehand if that is known, otherwise by
/// detecting a blow-up after a step. Its limits hold for the whole motion, including the release of pins.
class StabilityGuard {
 public:
  virtual ~StabilityGuard() = default;

  /// Returns the reason, as a sentence with a remedy, if the motion cannot be computed; otherwise nothing.
  [[nodiscard]] virtual std::optional<std::string> problem() const = 0;

  /// Returns the longest step that the scheme itself may take [s].
  [[nodiscard]] virtual double longest_step() const = 0;

  /// Function that returns K + E of the present state [J]; called only if needed.
  using EnergyNow = std::function<double()>;

  /// Begins to watch a motion, or restarts from another state of it.
  virtual void begin(const State& /*state*/, const EnergyNow& /*energy*/) {}

  /// Checks a step that ended in a state, after its `step` was advanced.
  /// @param push forces of the step, n×3 [N]; @param constant true if they are the same in every step
  /// @returns the ratio of the cloth's energy to the explained energy, if it is too large
  virtual std::optional<double> look(const State& /*state*/, const Vertices& /*push*/, bool /*constant*/,
                                     const EnergyNow& /*energy*/) {
    return std::nullopt;
  }

  /// Returns the checkpoint state of the watch, if any.
  [[nodiscard]] virtual std::optional<BlowUpWatch::EnergyHistory> books() const { return std::nullopt; }
  /// Restores the checkpoint state of a motion.
  virtual void go_on(const BlowUpWatch::EnergyHistory& /*books*/) {}

  /// Returns the advice for a motion that blew up, as the end of a message.
  [[nodiscard]] virtual std::string remedy() const = 0;
};

}  // namespace drape
