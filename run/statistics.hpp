#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "run/energy_rise.hpp"
#include "run/error_monitor.hpp"

namespace drape {

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
  std::int64_t iterations_ = 0, not_converged_ = 0, substeps_ = 0, max_substeps_ = 0;
  int max_iterations_ = 0;
  std::size_t replayed_ = 0;  // number of steps
  double worst_residual_ = 0;
  ErrorMonitor exactness_;
  EnergyRise energy_rise_;
};

}  // namespace drape
