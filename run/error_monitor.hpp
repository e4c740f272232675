#pragma once

#include <cstdint>
#include <optional>

#include "run/step_observer.hpp"

namespace drape {

/// Estimates of the solver error of a run's steps, and of the residual_force force on a cloth at rest. The estimates do
/// not change the motion.
class ErrorMonitor final : public StepObserver {
 public:
  void begin(const Simulation& simulation) override;
  /// Records the error of a step that has an error estimate: one that met an error tolerance or was given an accuracy.
  /// In other runs estimates the error of every 128th step only, since an estimate costs some iterations.
  void after_step(const Simulation& simulation, const StepReport& report, double seconds) override;
  /// Records a step of an earlier run, see StepObserver.
  void replay(const StepRow& row, double time, double seconds) override;
  /// Estimates the error of the last step, and the residual_force force if the cloth is at rest.
  void finish(const Simulation& simulation);

  /// Returns the stopping criterion of a step; nothing for a method without minimisation.
  [[nodiscard]] const std::optional<Accuracy>& accuracy() const { return accuracy_; }

  /// Returns the error allowed per step [m]; nothing if no accuracy was given.
  [[nodiscard]] const std::optional<double>& asked() const { return asked_; }

  /// Returns the error of a step [m], if that step is the last one estimated.
  [[nodiscard]] std::optional<double> error_of(std::int64_t step) const {
    return last_ == step ? std::optional(last_error_) : std::nullopt;
  }

  /// The distance of the worst vertex from the exact solution, over the estimated steps [m]. Includes the error of the
  /// time step only if an accuracy was given.
  struct Errors {
    double mean, largest;
  };
  /// Returns nothing if no step was estimated.
  [[nodiscard]] std::optional<Errors> errors() const;
  /// Returns true if the mean error exceeds a hundredth of the cloth's size.
  [[nodiscard]] bool coarse() const;

  /// The residual_force forces on a cloth at rest, as the norm of each vertex's force.
  struct ResidualForce {
    double force;                     ///< [N]
    std::optional<double> of_weight;  ///< share of the weight; absent without gravity
    /// Returns true if the force exceeds 1 % of the weight, several times the error that default steps leave.
    [[nodiscard]] bool notable() const { return of_weight && *of_weight > 0.01; }
  };
  /// Returns nothing if the cloth moves at the end, or if the method minimises nothing.
  [[nodiscard]] const std::optional<ResidualForce>& residual_force() const { return residual_force_; }

 private:
  void look(const Simulation& simulation);
  void note(std::int64_t step, double error);

  std::optional<Accuracy> accuracy_;
  std::optional<double> asked_;
  double size_ = 0;  // size of the cloth [m]
  double sum_ = 0, largest_ = 0, last_error_ = 0;
  std::int64_t looked_at_ = 0, last_ = 0;  // number of estimated steps, and the last one
  std::optional<ResidualForce> residual_force_;
};

}  // namespace drape
