#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "core/error.hpp"
#include "sim/blow_up.hpp"
#include "sim/energies.hpp"
#include "sim/schemes/scheme.hpp"
#include "sim/schemes/stability_guard.hpp"
#include "sim/settings.hpp"
#include "sim/spring_network.hpp"
#include "sim/step_forces.hpp"
#include "sim/system.hpp"

namespace drape {

/// What acts on the cloth with the settings' effects. Refers to the settings, which must outlive it.
/// @param effect_seconds if given, one number for each effect, to which the time that it takes is added from then on
System make_system(const SimulationSettings& settings, std::vector<double>* effect_seconds = nullptr);
/// The same in steps of another length [s].
System make_system(const SimulationSettings& settings, double step, std::vector<double>* effect_seconds = nullptr);

/// Whether a simulation measures what its effects take.
enum class Timing { none, effects };

/// A cloth in motion: owns its state, what acts on it, and the scheme by which it advances. No threads, no files. The
/// same settings give the same bits.
class Simulation {
 public:
  /// @throws UsageError if the motion cannot be computed, see stability_problem() and MethodType::make
  explicit Simulation(SimulationSettings settings, Timing timing = Timing::none);
  ~Simulation();
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;

  /// Advances the cloth by one step.
  /// @throws DivergedError if a position or velocity is no longer finite, or the cloth gains energy out of
  ///         nothing, see StabilityGuard
  StepReport step();

  /// Goes on from another state of the same cloth, at any step.
  void restore(const State& state);

  /// All that the rest of the motion depends on, to the bit: also the step in which it diverges.
  struct Checkpoint {
    State state;
    std::optional<BlowUpWatch::Books> books;  ///< where something watches the energy
  };
  [[nodiscard]] Checkpoint checkpoint() const { return {state_, guard_->books()}; }
  /// Goes on where a simulation of the same settings was, as that would have gone on.
  void restore(const Checkpoint& checkpoint);

  [[nodiscard]] const State& state() const { return state_; }
  [[nodiscard]] double time() const { return system_->time(state_.step); }
  /// Its pins are those of the last step.
  [[nodiscard]] const Cloth& cloth() const { return settings_.cloth; }
  [[nodiscard]] const SimulationSettings& settings() const { return settings_; }
  /// All springs, those of effects included.
  [[nodiscard]] const std::vector<Spring>& springs() const { return system_->springs; }
  /// What each effect of the settings has taken within the steps so far [s]; empty unless it is measured. The springs
  /// that an effect adds are not in it: they are computed together with the cloth's.
  [[nodiscard]] const std::vector<double>& effect_seconds() const { return effect_seconds_; }

  [[nodiscard]] Energies energies() const;
  /// ‖∇g‖ [N] where the last step ended, see Scheme::residual.
  [[nodiscard]] double residual() const { return scheme_->residual(); }
  /// The estimated error of the last step's solve [m], see Scheme::error.
  [[nodiscard]] double error() const { return scheme_->error(); }
  /// The forces left out of balance there [N], see Scheme::unbalanced.
  [[nodiscard]] double unbalanced() const { return scheme_->unbalanced(); }
  /// Σ m‖g‖ [N].
  [[nodiscard]] double weight() const { return settings_.cloth.masses.sum() * system_->gravity.norm(); }
  /// When a step is accurate enough; nothing where nothing is minimised.
  [[nodiscard]] std::optional<Accuracy> accuracy() const { return scheme_->accuracy(); }
  /// Where everything that the cloth can touch is at a time [s].
  [[nodiscard]] std::vector<Collider> colliders(double time) const { return system_->colliders_at(time); }

 private:
  /// Makes the system and the scheme for the pins of the next step, unless they are those.
  void enter_phase();
  /// Of the system, for the settings.
  std::unique_ptr<Scheme> make_scheme();
  /// Where to add what the effects take, if that is measured.
  std::vector<double>* measured() { return effect_seconds_.empty() ? nullptr : &effect_seconds_; }
  /// @param growth of the energy, see BlowUpWatch; absent: the numbers are no longer finite
  [[nodiscard]] DivergedError diverged_by(std::optional<double> growth) const;

  SimulationSettings settings_;
  std::vector<double> effect_seconds_;
  std::optional<System> system_;  // always there, and made anew for every phase
  std::vector<PinPhase> phases_;  // by step, the first from 0 on
  std::size_t phase_ = 0;
  State state_;
  StepForces forces_;
  std::unique_ptr<StabilityGuard> guard_;
  std::unique_ptr<Scheme> scheme_;
  SpringNetwork springs_;
  mutable Eigen::VectorXd per_vertex_;  // for energies(), which takes nothing from the heap…
  mutable Vertices ignored_;            // …and this is a gradient that comes with an energy
  StabilityGuard::EnergyNow energy_;    // K + E
};

}  // namespace drape
