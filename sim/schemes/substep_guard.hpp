#pragma once

#include <cstdint>
#include <memory>

#include "sim/schemes/stability_guard.hpp"

namespace drape {

/// For steps that are cut into substeps, see SubstepScheme: another guard says how short these have to be. What goes
/// wrong in a step needs no watch, since two motions that differ in their substeps would not agree about it.
class SubstepGuard final : public StabilityGuard {
 public:
  /// More than 2^20 substeps are not begun with.
  static constexpr double most_substeps = 1 << 20;

  /// @param guard of the scheme @param step that is cut [s]
  SubstepGuard(std::unique_ptr<StabilityGuard> guard, double step);

  /// Into how many substeps a step has to be cut until they are no longer than another [s]; no more than are allowed.
  static std::int64_t fewest_substeps(double step, double longest);

  [[nodiscard]] std::optional<std::string> problem() const override;
  [[nodiscard]] double longest_step() const override { return guard_->longest_step(); }
  [[nodiscard]] std::string remedy() const override { return "; take a shorter [time] step, or weaker forces"; }

 private:
  std::unique_ptr<StabilityGuard> guard_;
  double step_;  // [s]
};

}  // namespace drape
