#pragma once

#include <cstdint>
#include <optional>

#include "run/step_observer.hpp"

namespace drape {

/// How exactly the steps of a run were solved, and whether a cloth that came to rest is in equilibrium. Both are
/// estimates of the program about its own result: they change nothing of it.
class Exactness final : public StepObserver {
 public:
  void begin(const Simulation& simulation) override;
  /// Looks at every step whose error is known, because it stopped at one or an accuracy was asked for, and else at
  /// every 128th, since it costs some iterations.
  void after_step(const Simulation& simulation, const StepReport& report, double seconds) override;
  /// A step that was done before, see StepObserver.
  void replay(const StepRow& row, double time, double seconds) override;
  /// Looks at the last step, and whether the cloth stands still.
  void finish(const Simulation& simulation);

  /// When a step was accurate enough; nothing where nothing is minimised.
  [[nodiscard]] const std::optional<Accuracy>& accuracy() const { return accuracy_; }

  /// What a step was asked to add to the error at most [m]; nothing where it was not.
  [[nodiscard]] const std::optional<double>& asked() const { return asked_; }

  /// The error of a step, if it was the last one that was looked at.
  [[nodiscard]] std::optional<double> error_of(std::int64_t step) const {
    return last_ == step ? std::optional(last_error_) : std::nullopt;
  }

  /// The error of the steps that were looked at: how far their worst vertex is from the exact solution [m]. That of the
  /// time step is in it where an accuracy was asked for, and else is not.
  struct Errors {
    double mean, largest;
  };
  /// Nothing where nothing was looked at.
  [[nodiscard]] std::optional<Errors> errors() const;
  /// Whether the mean error is one that nobody would call accurate, above a hundredth of the cloth's size.
  [[nodiscard]] bool coarse() const;

  /// The forces out of balance on a cloth that stands still, each vertex's by itself.
  struct Unbalanced {
    double force;                     ///< [N]
    std::optional<double> of_weight;  ///< where there is gravity
    /// Whether it is more than the error of a default step leaves, several times over.
    [[nodiscard]] bool notable() const { return of_weight && *of_weight > 0.01; }
  };
  /// Nothing where the cloth moves at the end, or nothing is minimised.
  [[nodiscard]] const std::optional<Unbalanced>& unbalanced() const { return unbalanced_; }

 private:
  void look(const Simulation& simulation);
  void note(std::int64_t step, double error);

  std::optional<Accuracy> accuracy_;
  std::optional<double> asked_;
  double size_ = 0;  // of the cloth [m]
  double sum_ = 0, largest_ = 0, last_error_ = 0;
  std::int64_t looked_at_ = 0, last_ = 0;  // steps, and the number of the last of them
  std::optional<Unbalanced> unbalanced_;
};

}  // namespace drape
