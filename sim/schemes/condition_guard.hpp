#pragma once

#include "sim/schemes/stability_guard.hpp"

namespace drape {

/// For schemes that solve for the end of a step, which is stable as far as double precision holds the inertia of a
/// vertex beside what pulls at it, see condition_bound().
class ConditionGuard final : public StabilityGuard {
 public:
  explicit ConditionGuard(const System& system);

  [[nodiscard]] std::optional<std::string> problem() const override;
  /// Pushes that are evaluated once in a step have one of their own.
  [[nodiscard]] double longest_step() const override;
  [[nodiscard]] std::string remedy() const override { return "; take a shorter [time] step, or weaker forces"; }

 private:
  double step_;  // [s]
  double condition_;
  double longest_pushed_;  // [s]
};

}  // namespace drape
