#pragma once

#include "sim/schemes/stability_guard.hpp"

namespace drape {

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

}  // namespace drape
