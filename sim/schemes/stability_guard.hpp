#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "sim/stability.hpp"
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

  /// Function that returns K + E of the present state [J], or an upper bound that is not above `enough`; called only if
  /// needed.
  using EnergyNow = std::function<double(double enough)>;

  /// Begins to watch a motion, or restarts from another state of it.
  /// @param energy K + E of the state [J]
  virtual void begin(const State& /*state*/, double /*energy*/) {}

  /// Checks a step that ended in a state, after its `step` was advanced.
  /// @param push forces of the step, n×3 [N]; @param constant true if they are the same in every step
  /// @returns the ratio of the cloth's energy to the explained energy, if it is too large
  virtual std::optional<double> check_step(const State& /*state*/, const Vertices& /*push*/, bool /*constant*/,
                                           const EnergyNow& /*energy*/) {
    return std::nullopt;
  }

  /// Returns the checkpoint state of the watch, or null.
  [[nodiscard]] virtual const EnergyMemory* memory() const { return nullptr; }
  /// Restores the checkpoint state of a motion.
  virtual void restore(const EnergyMemory& /*memory*/) {}

  /// Returns the advice for a motion that blew up, as the end of a message.
  [[nodiscard]] virtual std::string remedy() const = 0;
};

/// Guard for schemes that are stable up to safe_step() and may gain energy beyond it.
class SafeStepGuard final : public StabilityGuard {
 public:
  /// Computes the safe step, which takes a while for a large cloth.
  /// @param scheme name of the scheme in messages
  SafeStepGuard(std::string_view scheme, const System& system);

  [[nodiscard]] std::optional<std::string> problem() const override;
  [[nodiscard]] double longest_step() const override { return safe_step_; }
  void begin(const State& state, double energy) override;
  std::optional<double> check_step(const State& state, const Vertices& push, bool constant,
                                   const EnergyNow& energy) override;
  [[nodiscard]] const EnergyMemory* memory() const override { return watch_ ? &watch_->memory() : nullptr; }
  void restore(const EnergyMemory& memory) override;
  [[nodiscard]] std::string remedy() const override;

 private:
  std::string_view scheme_;
  double step_, safe_step_;           // [s]
  std::optional<BlowUpWatch> watch_;  // if energy is meaningful for this motion
};

/// Guard for implicit schemes. These are stable while double precision resolves a vertex's inertia beside the stiffness
/// acting on it, see condition_bound().
class ConditionGuard final : public StabilityGuard {
 public:
  explicit ConditionGuard(const System& system);

  [[nodiscard]] std::optional<std::string> problem() const override;
  /// Returns the longest step, which also respects the limit of pushes evaluated once per step [s].
  [[nodiscard]] double longest_step() const override;
  [[nodiscard]] std::string remedy() const override { return "; take a shorter [time] step, or weaker forces"; }

 private:
  double step_;  // [s]
  double condition_;
  double longest_pushed_;  // [s]
};

/// Guard for steps divided into substeps, see SubstepScheme; another guard gives the longest substep. No blow-up watch
/// is needed: the accelerations of an unstable motion change so much that its estimated error is too large.
class SubstepGuard final : public StabilityGuard {
 public:
  /// Limit above which a motion is rejected.
  static constexpr double most_substeps = 1 << 20;

  /// @param guard of the scheme @param step to divide [s]
  SubstepGuard(std::unique_ptr<StabilityGuard> guard, double step);

  /// Returns the number of substeps no longer than `longest` [s] that divide a step, capped at the limit.
  static std::int64_t fewest_substeps(double step, double longest);

  [[nodiscard]] std::optional<std::string> problem() const override;
  [[nodiscard]] double longest_step() const override { return guard_->longest_step(); }
  [[nodiscard]] std::string remedy() const override { return "; take a shorter [time] step, or weaker forces"; }

 private:
  std::unique_ptr<StabilityGuard> guard_;
  double step_;  // [s]
};

}  // namespace drape
