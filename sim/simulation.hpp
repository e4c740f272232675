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

#include "core/error.hpp"
#include "sim/collider.hpp"
#include "sim/energies.hpp"
#include "sim/settings.hpp"
#include "sim/solvers/accuracy.hpp"
#include "sim/state.hpp"
#include "sim/step_report.hpp"
#include "sim/stop.hpp"

namespace drape {

/// Whether a simulation measures the computing time of its effects.
enum class Timing { none, effects };

/// A cloth in motion: owns its state, what acts on it, and the scheme by which it advances. No files, and no threads
/// but those that the settings ask for. The same settings give the same bits, with any number of threads. It can be
/// moved; one that has been moved from can only be assigned to.
class Simulation {
 public:
  /// @param settings as a scene has them: a positive step, at least one thread, and effects whose check() finds nothing
  ///                 wrong, which is not called again
  /// @param stop asked for as long as it lives
  /// @throws UsageError if the settings are not valid, see require_valid(), or the motion cannot be computed, see
  ///         stability_problem() and MethodType::make
  /// @throws Interrupted
  explicit Simulation(SimulationSettings settings, Timing timing = Timing::none, const Stop& stop = {});
  ~Simulation();
  Simulation(Simulation&&) noexcept;
  Simulation& operator=(Simulation&&) noexcept;

  /// Advances the cloth by one step.
  /// @throws DivergedError if a position or velocity is no longer finite, or the cloth gains energy out of
  ///         nothing, see StabilityGuard
  /// @throws Interrupted between any two pieces of its work. Everything that the motion depends on is then as it was
  ///         before the step; what is said of the last step below is not.
  StepReport step();

  /// Takes the last step back, where a stop is possible; once, and not if anything was restored since. For an
  /// interruption that comes while a finished step is being examined.
  void take_back();

  /// Continues from another state of the same cloth, at any step.
  void restore(const State& state);

  /// All that the rest of the motion depends on, to the bit: also the step in which it diverges.
  struct Checkpoint {
    State state;
    std::optional<EnergyMemory> books;  ///< where something watches the energy
  };
  [[nodiscard]] Checkpoint checkpoint() const;
  /// Continues where another simulation of the same settings was, exactly as that one would have.
  void restore(const Checkpoint& checkpoint);

  [[nodiscard]] const State& state() const;
  /// A hash of the state to the bit, see hash_of(). It is the same on every run of the same settings, for every
  /// instruction set and number of threads.
  [[nodiscard]] std::uint64_t hash() const { return hash_of(state()); }
  [[nodiscard]] double time() const;  ///< [s]
  /// Its pins are those of the last step.
  [[nodiscard]] const Cloth& cloth() const { return settings().cloth; }
  [[nodiscard]] const SimulationSettings& settings() const;
  /// All springs, those of effects included.
  [[nodiscard]] const std::vector<Spring>& springs() const;
  /// The computing time of each effect in the steps so far [s]; empty unless it is measured. The springs
  /// that an effect adds are not in it: they are computed together with the cloth's.
  [[nodiscard]] const std::vector<double>& effect_seconds() const;

  [[nodiscard]] Energies energies() const;
  /// Whether a scheme solves for the end of a step in which the cloth may touch something, and nothing gives it energy:
  /// the total can then only fall, see System::only_loses_energy().
  [[nodiscard]] bool only_loses_energy() const;
  /// ‖∇g‖ [N] where the last step ended, see Scheme::residual.
  [[nodiscard]] double residual() const;
  /// The estimated error of the last step's solve [m], see Scheme::error. @throws Interrupted
  [[nodiscard]] double error() const;
  /// The forces left out of balance there [N], see Scheme::unbalanced.
  [[nodiscard]] double unbalanced() const;
  /// Σ m‖g‖ [N].
  [[nodiscard]] double weight() const;
  /// When a step is accurate enough; nothing where nothing is minimised.
  [[nodiscard]] std::optional<Accuracy> accuracy() const;
  /// Everything that the cloth can touch, where it is at a time [s].
  [[nodiscard]] std::vector<Collider> colliders(double time) const;

 private:
  class Motion;
  std::unique_ptr<Motion> motion_;
};

}  // namespace drape
