#pragma once

#include <cstdint>
#include <optional>

#include "core/error.hpp"
#include "sim/system.hpp"

namespace drape {

/// The motion blew up, or left the range of finite numbers.
class DivergedError : public Error {
 public:
  using Error::Error;
  explicit DivergedError(const std::string& message) : Error(ExitCode::diverged, message) {}
};

/// Recognises the step in which an unstable motion has more energy than can be explained. Symplectic Euler with a
/// stable step keeps K + E − (h/2)·v·∇E of a linear cloth, so its energy K + E stays within a factor of (1 + hω/2)/(1 −
/// hω/2); with an unstable step it grows by a constant factor in every step. The watch keeps what the cloth had and
/// what the forces gave it, Σ|f·Δx|, and calls ten thousand times that a blow-up: far beyond what a stable motion has,
/// and a few steps after its beginning.
class BlowUpWatch {
 public:
  static constexpr double limit = 1e4;

  explicit BlowUpWatch(const System& system);

  /// Begins with a state of this energy, K + E [J].
  void begin(double energy);
  /// Takes note of a step in which the forces at its start did this work, |f·Δx|, and which ended with this energy [J].
  /// @returns how many times the energy that is explained, if that is beyond the limit
  std::optional<double> after_step(double work, double energy);

 private:
  double rounding_;       // what rounding the positions does to the energy [J]
  double explained_ = 0;  // [J]
};

/// A motion's last state and why it cannot go on.
struct BlowUp {
  std::optional<double> growth;     ///< of the energy, see BlowUpWatch; absent: the numbers are no longer finite
  std::optional<double> safe_step;  ///< of semi-implicit Euler [s]; absent for the implicit methods
};

/// Names the step, the time, the worst vertex (the first that is not finite, else the fastest), the energy's growth,
/// and the largest stable step or the methods to use instead.
DivergedError diverged(const State& state, double time, const BlowUp& what);

}  // namespace drape
