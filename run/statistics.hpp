#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "drape/sim/simulation.hpp"
#include "drape/sim/state.hpp"
#include "motion/encoding.hpp"

namespace drape {

/// An observer of a simulation, called from the simulating thread.
class StepObserver {
 public:
  virtual ~StepObserver() = default;
  /// Called before the first step.
  virtual void begin(const Simulation& /*simulation*/) {}
  /// Called after begin() in a resumed run, for every earlier step; the first call is the start, as step 0.
  /// @param time    end of the step [s]
  /// @param seconds computing time of the step [s]
  virtual void replay(const StepRow& /*row*/, double /*time*/, double /*seconds*/) {}
  /// Called after every step.
  /// @param seconds computing time of the step [s]
  /// @throws Interrupted only from the first of several observers; the step is then undone
  virtual void after_step(const Simulation& simulation, const StepReport& report, double seconds) = 0;
};

/// Monitor of the total energy of a cloth that nothing feeds with energy. An impact in a long step can create energy.
/// The monitor does not change the motion.
class EnergyRise final : public StepObserver {
 public:
  void begin(const Simulation& simulation) override;
  void after_step(const Simulation& simulation, const StepReport& report, double seconds) override;
  /// Records a step of an earlier run, see StepObserver.
  void replay(const StepRow& row, double time, double seconds) override;

  /// The largest rise of the total energy above its least value before [J], and its share of the available energy.
  /// Available are the kinetic and elastic energy at the start, and the weight times the fall of the centre of mass. If
  /// an obstacle pushes with a force, its potential is left out, and the rise is that above the start.
  struct Rise {
    double energy, of_available;
    /// Returns true if the rise exceeds 1 % of the available energy, more than a step's tolerance explains.
    [[nodiscard]] bool notable() const { return of_available > 0.01; }
  };
  /// Returns the rise; nothing if the cloth touches nothing or gets energy from outside, as from a start nearer to
  /// something than its contact distance.
  [[nodiscard]] std::optional<Rise> rise() const;

 private:
  void note(const Energies& now);

  // Steps of an explicit method between two checks: an energy costs as much as a step, and a rise lasts longer.
  static constexpr std::int64_t check_interval = 8;

  bool watches_ = false, from_start_ = false;
  bool asked_ = false;             // true if it is known whether the cloth began too near to something
  std::int64_t every_ = 1;         // number of steps
  std::optional<Energies> first_;  // energies at the start
  double least_ = std::numeric_limits<double>::infinity(), available_ = 0, rise_ = 0;  // [J]
};

/// Estimates of the solver error of a run's steps, and of the residual force on a cloth at rest. The estimates do
/// not change the motion.
class ErrorMonitor final : public StepObserver {
 public:
  void begin(const Simulation& simulation) override;
  /// Records the error of a step that has an error estimate: one that met an error tolerance or was given an accuracy.
  /// In other runs estimates the error of every 128th step only, since an estimate costs some iterations.
  void after_step(const Simulation& simulation, const StepReport& report, double seconds) override;
  /// Records a step of an earlier run, see StepObserver.
  void replay(const StepRow& row, double time, double seconds) override;
  /// Estimates the error of the last step, and the residual force if the cloth is at rest.
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

  /// Sum over the vertices of the residual force's norm, of a cloth at rest.
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

/// Statistics of the steps of a run.
class Statistics final : public StepObserver {
 public:
  void begin(const Simulation& simulation) override;
  void after_step(const Simulation& simulation, const StepReport& report, double seconds) override;
  void replay(const StepRow& row, double time, double seconds) override;
  /// Completes the error estimates after the last step.
  void finish(const Simulation& simulation) { exactness_.finish(simulation); }

  [[nodiscard]] std::int64_t steps() const { return static_cast<std::int64_t>(microseconds_.size()); }
  [[nodiscard]] double mean_iterations() const;
  [[nodiscard]] int max_iterations() const { return max_iterations_; }
  /// Returns the number of steps that reached the iteration limit before the stopping criterion or the accuracy.
  [[nodiscard]] std::int64_t not_converged() const { return not_converged_; }
  /// Returns the largest residual ‖∇g‖ of these steps [N].
  [[nodiscard]] double worst_residual() const { return worst_residual_; }
  /// Returns the number of steps in which SDIRK2 gained energy, so that backward Euler took them instead.
  [[nodiscard]] std::int64_t redone() const { return redone_; }
  /// Returns the message of a run that had to redo too many steps, otherwise nothing.
  [[nodiscard]] std::optional<std::string> instability() const;
  /// Returns the mean number of substeps per step.
  [[nodiscard]] double mean_substeps() const;
  [[nodiscard]] std::int64_t max_substeps() const { return max_substeps_; }
  [[nodiscard]] const ErrorMonitor& exactness() const { return exactness_; }
  [[nodiscard]] std::optional<EnergyRise::Rise> energy_rise() const { return energy_rise_.rise(); }
  /// Returns the time of each step [µs].
  [[nodiscard]] const std::vector<float>& microseconds() const { return microseconds_; }
  [[nodiscard]] double mean_microseconds() const;
  [[nodiscard]] double median_microseconds() const;
  [[nodiscard]] double total_seconds() const;

  /// An effect of the scene and its share of the step time.
  struct EffectShare {
    std::string name;
    std::optional<double> share;  ///< 0 to 1, over the new steps of a resumed run; absent if not measured
  };
  /// Returns every effect of the scene, in the order of evaluation.
  [[nodiscard]] std::vector<EffectShare> effects() const;

  /// Returns the contents of the --stats file.
  /// @param outcome "completed", "interrupted" or "diverged"
  [[nodiscard]] std::string to_json(const std::string& outcome) const;

 private:
  void note(int iterations, std::int64_t substeps, bool converged, double residual, double seconds);
  /// Returns the time of this run's own steps, without replayed ones [s].
  [[nodiscard]] double own_seconds() const;

  std::string method_, scheme_;
  std::int64_t vertices_ = 0, springs_ = 0;
  double h_ = 0;
  std::vector<std::string> effects_;
  std::vector<double> effect_seconds_;  // empty unless the simulation measures them [s]
  std::vector<float> microseconds_;
  std::int64_t iterations_ = 0, not_converged_ = 0, redone_ = 0, substeps_ = 0, max_substeps_ = 0;
  int max_iterations_ = 0;
  std::size_t replayed_ = 0;  // number of steps
  double worst_residual_ = 0;
  ErrorMonitor exactness_;
  EnergyRise energy_rise_;
};

}  // namespace drape
