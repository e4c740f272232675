#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "core/error.hpp"
#include "sim/system.hpp"

namespace drape {

/// Recognises that a motion has more energy than can be explained: than what the cloth had and what the forces gave
/// it, Σ|f·Δx|.
class BlowUpWatch {
 public:
  static constexpr double limit_of_unstable_steps = 1e4;
  /// How many times the energy that is explained is a blow-up of an explicit method. Symplectic Euler keeps K + E −
  /// (h/2)·v·∇E of a linear cloth. With r = step/safe_step() < 1 that is between (1 − r) and (1 + r) times K + E, which
  /// so stays within a factor of (1 + r)/(1 − r); the limit is four times that. Velocity Verlet keeps (1 − r²) K + E
  /// and stays nearer. Beyond r = 1 the energy grows by a constant factor in every step, and ten thousand times what is
  /// explained is far beyond what a stable motion has, and a few steps after the beginning of its end.
  /// @param ratio step/safe_step()
  static double limit(double ratio);

  /// @param limit    how many times the energy that is explained is a blow-up
  /// @param interval how many steps lie between two looks
  BlowUpWatch(const System& system, double limit, int interval);

  /// Begins with a state of this energy, K + E [J].
  void begin(const State& state, double energy);

  /// What it knows of the motion so far.
  using Books = EnergyMemory;
  [[nodiscard]] const Books& books() const { return books_; }
  /// Goes on with a motion of which it knew this.
  void go_on(const Books& books) { books_ = books; }

  /// Takes note of a step that has ended, and looks after every interval, see StabilityGuard::look.
  std::optional<double> look(const State& state, const Vertices& push, bool constant,
                             const std::function<double()>& energy);

 private:
  double step_;  // [s]
  double limit_;
  int interval_;
  double rounding_;  // what rounding the positions does to the energy [J]
  Books books_;
};

/// Names the step, the time, the worst vertex of a motion's last state (the first that is not finite, else the
/// fastest), the energy's growth, and what to change.
/// @param growth of the energy, see BlowUpWatch; absent: the numbers are no longer finite
/// @param remedy see StabilityGuard
DivergedError diverged(const State& state, double time, std::optional<double> growth, const std::string& remedy);

}  // namespace drape
