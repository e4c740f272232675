#pragma once

#include <cstdint>
#include <memory>

#include "sim/schemes/stability_guard.hpp"

namespace drape {

/// Guard for steps divided into substeps, see SubstepScheme; another guard gives the longest substep. No blow-up watch
/// is needed, as two unstable motions with different substeps would disagree.
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
