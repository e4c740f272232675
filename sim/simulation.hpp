#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "core/error.hpp"
#include "sim/blow_up.hpp"
#include "sim/integrators/integrator.hpp"
#include "sim/settings.hpp"
#include "sim/spring_network.hpp"
#include "sim/system.hpp"

namespace drape {

/// The energies of a cloth at one moment [J].
struct Energies {
  double kinetic = 0;  ///< Σ m v²/2
  double gravity = 0;  ///< −Σ m g·x
  double elastic = 0;  ///< of all springs and of bending

  [[nodiscard]] double total() const { return kinetic + gravity + elastic; }
};

/// What acts on the cloth with the settings' effects. Refers to the settings, which must outlive it.
/// @param effect_seconds if given, one number for each effect, to which the time that it takes is added from then on
System make_system(const SimulationSettings& settings, std::vector<double>* effect_seconds = nullptr);

/// Whether a simulation measures what its effects take.
enum class Timing { none, effects };

/// A cloth in motion: owns its state, what acts on it, and the integrator. No threads, no files. The same settings give
/// the same bits.
class Simulation {
 public:
  /// @throws UsageError if the motion cannot be computed, see stability_problem(), or a matrix of the integrator would
  ///         not fit into memory or cannot be factored to working precision
  explicit Simulation(SimulationSettings settings, Timing timing = Timing::none);
  ~Simulation();
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;

  /// Advances the cloth by one step.
  /// @throws DivergedError if a position or velocity is no longer finite, or semi-implicit Euler gains energy out of
  ///         nothing, see BlowUpWatch
  StepReport step();

  /// Goes on from another state of the same cloth, at any step.
  void restore(const State& state);

  [[nodiscard]] const State& state() const { return state_; }
  [[nodiscard]] double time() const { return time_of(state_.step); }
  /// Its pins are those of the last step.
  [[nodiscard]] const Cloth& cloth() const { return settings_.cloth; }
  [[nodiscard]] const SimulationSettings& settings() const { return settings_; }
  /// All springs, those of effects included.
  [[nodiscard]] const std::vector<Spring>& springs() const { return system_->springs; }
  /// What each effect of the settings has taken within the steps so far [s]; empty unless it is measured. The springs
  /// that an effect adds are not in it: they are computed together with the cloth's.
  [[nodiscard]] const std::vector<double>& effect_seconds() const { return effect_seconds_; }

  [[nodiscard]] Energies energies() const;
  /// ‖∇g‖ [N] where the last step ended, see Integrator::residual.
  [[nodiscard]] double residual() const { return integrator_->residual(); }
  /// Where everything that the cloth can touch is at a time [s].
  [[nodiscard]] std::vector<Collider> colliders(double time) const;

 private:
  /// Makes the system and the integrator for the pins of the next step, unless they are those.
  void enter_phase();
  /// The sum of all forces now.
  [[nodiscard]] const Vertices& force();
  /// Ends the simulation if its last steps gained energy out of nothing. @param push the forces of the last one
  void look_for_blow_up(const Vertices& push);
  [[nodiscard]] DivergedError diverged_with(std::optional<double> growth) const;
  [[nodiscard]] double time_of(std::int64_t step) const { return static_cast<double>(step) * settings_.step; }

  SimulationSettings settings_;
  std::vector<double> effect_seconds_;
  std::optional<System> system_;  // always there, and made anew for every phase
  std::vector<PinPhase> phases_;  // by step, the first from 0 on
  std::size_t phase_ = 0;
  State state_;
  Vertices constant_force_, force_;
  double safe_step_;  // of semi-implicit Euler, else 0 [s]
  std::unique_ptr<Integrator> integrator_;
  SpringNetwork springs_;
  mutable Eigen::VectorXd per_vertex_;  // for energies(), which takes nothing from the heap…
  mutable Vertices ignored_;            // …and this is a gradient that comes with an energy
  std::optional<BlowUpWatch> watch_;    // of semi-implicit Euler
  Vertices looked_at_;                  // where the cloth was when it last looked
  double work_ = 0;                     // since then [J]
};

}  // namespace drape
