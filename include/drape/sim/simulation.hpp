#pragma once

// Example:
//   const drape::Mesh square = drape::make_grid(20, 20);
//   drape::Simulation simulation({
//       .cloth = drape::make_cloth(square, square, 1, 180, {0, 20}),
//       .step = 0.01,
//       .effects = {drape::Gravity{}, drape::Damping{.factor = 0.2}},
//   });
//   for (int i = 0; i < 100; ++i) simulation.step();
//   std::printf("%g m, %016llx", simulation.state().x.col(2).minCoeff(), (unsigned long long)simulation.hash());

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "drape/core/error.hpp"
#include "drape/sim/settings.hpp"
#include "drape/sim/solvers/accuracy.hpp"
#include "drape/sim/state.hpp"

namespace drape {

/// Option to measure the computing time of effects.
enum class Timing { none, effects };

/// A cloth in motion: owns its state, the effects, and the scheme. It uses no files, and only the threads requested in
/// the settings. The same settings give the same bits, with any number of threads. It can be moved; a moved-from
/// simulation can only be assigned to.
class Simulation {
 public:
  /// @param settings as from a scene: a positive step, at least one thread, and effects that pass check(), which is not
  ///                 called again
  /// @param stop checked during its lifetime
  /// @throws UsageError if the settings are invalid, see require_valid(), or the motion cannot be computed, see
  ///         stability_problem() and MethodType::make
  /// @throws Interrupted
  explicit Simulation(SimulationSettings settings, Timing timing = Timing::none, const Stop& stop = {});
  ~Simulation();
  Simulation(Simulation&&) noexcept;
  Simulation& operator=(Simulation&&) noexcept;

  /// Advances the cloth by one step.
  /// @throws DivergedError if a position or velocity is no longer finite, or the cloth gains unexplained energy, see
  ///         StabilityGuard
  /// @throws Interrupted between any two pieces of its work. The state is then as before the step. Data about the last
  ///         step, such as residual(), are not preserved.
  StepReport step();

  /// Undoes the last step if a stop is possible; only once, and not after a restore. For an interruption while a
  /// finished step is examined.
  void undo_step();

  /// Continues from another state of the same cloth, at any step.
  void restore(const State& state);

  /// Complete state of a motion: a continued run gives the same bits, including the step in which it diverges.
  struct Checkpoint {
    State state;
    std::optional<EnergyMemory> energy_memory;  ///< if the energy is watched
  };
  [[nodiscard]] Checkpoint checkpoint() const;
  /// Restores a checkpoint of a simulation with the same settings and continues exactly like it.
  void restore(const Checkpoint& checkpoint);

  [[nodiscard]] const State& state() const;
  /// Returns a hash of the state's bits, see hash_of(). It is the same on every run of the same settings, for every
  /// instruction set and number of threads.
  [[nodiscard]] std::uint64_t hash() const { return hash_of(state()); }
  [[nodiscard]] double time() const;  ///< [s]
  /// Returns the cloth with the pins of the last step.
  [[nodiscard]] const Cloth& cloth() const { return settings().cloth; }
  [[nodiscard]] const SimulationSettings& settings() const;
  /// Returns all springs, including those of effects.
  [[nodiscard]] const std::vector<Spring>& springs() const;
  /// Returns the computing time of each effect so far [s]; empty unless measured. Springs of an effect are not
  /// included, as they are computed together with the cloth's.
  [[nodiscard]] const std::vector<double>& effect_seconds() const;

  [[nodiscard]] Energies energies() const;
  /// Returns the energies of each of several cloths, in the order of Cloth::pieces. Effects on single cloths and
  /// springs are counted; an elastic energy that belongs to several cloths is not.
  [[nodiscard]] std::vector<Energies> piece_energies() const;
  /// Returns true if the cloth may touch something and nothing adds energy, so that the total can only fall; see
  /// System::only_loses_energy().
  [[nodiscard]] bool only_loses_energy() const;
  /// Returns true if an obstacle pushes with a force, which stores energy that energies() leaves out.
  [[nodiscard]] bool has_push() const;
  /// Returns ‖∇g‖ at the end of the last step [N], see Scheme::residual.
  [[nodiscard]] double residual() const;
  /// Returns the estimated error of the last step's solve [m], see Scheme::error.
  /// @throws Interrupted
  [[nodiscard]] double error() const;
  /// Returns the residual forces of the last step [N], see Scheme::residual_force.
  [[nodiscard]] double residual_force() const;
  /// Returns Σ m‖g‖ [N].
  [[nodiscard]] double weight() const;
  /// Returns the stopping criterion of a step; nothing for methods that minimise nothing.
  [[nodiscard]] std::optional<Accuracy> accuracy() const;
  /// Returns all obstacles that the cloth can touch, at a time [s].
  [[nodiscard]] std::vector<Collider> colliders(double time) const;

 private:
  class Motion;
  std::unique_ptr<Motion> motion_;
};

}  // namespace drape
