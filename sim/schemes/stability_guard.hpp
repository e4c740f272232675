#pragma once

#include <functional>
#include <optional>
#include <string>

#include "sim/blow_up.hpp"
#include "sim/system.hpp"

namespace drape {

/// Stands between a scheme and the motions that it cannot compute: says so beforehand where that is known, and
/// recognises them in a step that has ended where it is not. What it finds out about a system holds for the motion,
/// whichever pins are released in it.
class StabilityGuard {
 public:
  virtual ~StabilityGuard() = default;

  /// Why the motion cannot be computed, in a sentence that says what to change; nothing where it can.
  [[nodiscard]] virtual std::optional<std::string> problem() const = 0;

  /// The longest step that the scheme itself may take [s].
  [[nodiscard]] virtual double longest_step() const = 0;

  /// K + E of the present state [J]; called only where it is needed.
  using EnergyNow = std::function<double()>;

  /// Begins to watch a motion, or goes on from another state of it.
  virtual void begin(const State& /*state*/, const EnergyNow& /*energy*/) {}

  /// Watches a step that has ended in a state whose `step` is counted already.
  /// @param push the forces of the step, n×3 [N]; @param constant whether they are those of every step
  /// @returns how many times the energy that is explained the cloth has, if that is too much
  virtual std::optional<double> look(const State& /*state*/, const Vertices& /*push*/, bool /*constant*/,
                                     const EnergyNow& /*energy*/) {
    return std::nullopt;
  }

  /// What it remembers of the motion, where that is anything: whoever goes on with it elsewhere needs it.
  [[nodiscard]] virtual std::optional<BlowUpWatch::Books> books() const { return std::nullopt; }
  /// Goes on with a motion of which it remembered this.
  virtual void go_on(const BlowUpWatch::Books& /*books*/) {}

  /// What to change about a motion that blew up: the end of a message.
  [[nodiscard]] virtual std::string remedy() const = 0;
};

}  // namespace drape
