#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "core/error.hpp"
#include "sim/system.hpp"

namespace drape {

/// The motion blew up, or left the range of finite numbers.
class DivergedError : public Error {
 public:
  explicit DivergedError(const std::string& message) : Error(ExitCode::diverged, message) {}
};

/// Recognises that a motion of semi-implicit Euler has more energy than can be explained: than what the cloth had and
/// what the forces gave it, Σ|f·Δx|.
///
/// Symplectic Euler keeps K + E − (h/2)·v·∇E of a linear cloth. With r = step/safe_step() < 1 that is between (1 − r)
/// and (1 + r) times K + E, which so stays within a factor of (1 + r)/(1 − r); the limit is four times that. Beyond r =
/// 1 the energy grows by a constant factor in every step, and ten thousand times what is explained is far beyond what a
/// stable motion has, and a few steps after the beginning of its end.
class BlowUpWatch {
 public:
  static constexpr double limit_of_unstable_steps = 1e4;
  /// How many times the energy that is explained is a blow-up.
  /// @param ratio step/safe_step()
  static double limit(double ratio);

  BlowUpWatch(const System& system, double safe_step);

  /// How many steps may lie between two looks: one beyond the safe step, and below it, where a cloth can only gain
  /// energy little by little, so many that looking costs nothing.
  [[nodiscard]] int interval() const { return interval_; }

  /// Begins with a state of this energy, K + E [J].
  void begin(double energy);
  /// Takes note of steps in which the forces did this work, Σ|f·Δx|, and which ended with this energy [J].
  /// @returns how many times the energy that is explained, if that is beyond the limit
  std::optional<double> look(double work, double energy);

 private:
  double limit_;
  int interval_;
  double rounding_;       // what rounding the positions does to the energy [J]
  double explained_ = 0;  // [J]
};

/// Names the step, the time, the worst vertex of a motion's last state (the first that is not finite, else the
/// fastest), the energy's growth, and what to change.
/// @param growth of the energy, see BlowUpWatch; absent: the numbers are no longer finite
/// @param remedy see StabilityGuard
DivergedError diverged(const State& state, double time, std::optional<double> growth, const std::string& remedy);

}  // namespace drape
