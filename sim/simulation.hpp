#pragma once

#include <memory>
#include <vector>

#include "core/error.hpp"
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

/// The motion left the range of finite numbers.
class DivergedError : public Error {
 public:
  DivergedError(std::int64_t step, double time, int vertex);
};

/// What acts on the cloth with the settings' effects. Refers to the settings, which must outlive it.
System make_system(const SimulationSettings& settings);

/// A cloth in motion: owns its state, what acts on it, and the integrator. No threads, no files. The same settings give
/// the same bits.
class Simulation {
 public:
  /// @throws UsageError if the step is larger than semi-implicit Euler's safe one, see safe_step(), or a matrix of the
  ///         integrator would not fit into memory
  /// @throws std::domain_error if a matrix of the integrator cannot be factored to working precision
  explicit Simulation(SimulationSettings settings);
  ~Simulation();
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;

  /// Advances the cloth by one step.
  /// @throws DivergedError if a position or velocity is no longer finite
  StepReport step();

  /// Goes on from another state of the same cloth.
  void restore(const State& state);

  [[nodiscard]] const State& state() const { return state_; }
  [[nodiscard]] double time() const { return time_of(state_.step); }
  [[nodiscard]] const Cloth& cloth() const { return settings_.cloth; }
  [[nodiscard]] const SimulationSettings& settings() const { return settings_; }
  /// All springs, those of effects included.
  [[nodiscard]] const std::vector<Spring>& springs() const { return system_.springs; }

  [[nodiscard]] Energies energies() const;
  /// ‖∇g‖ [N] where the last step ended, see Integrator::residual.
  [[nodiscard]] double residual() const { return integrator_->residual(); }
  /// Where everything that the cloth can touch is at a time [s].
  [[nodiscard]] std::vector<Collider> colliders(double time) const;

 private:
  /// The sum of all forces now.
  [[nodiscard]] const Vertices& force();
  [[noreturn]] void throw_diverged() const;
  [[nodiscard]] double time_of(std::int64_t step) const { return static_cast<double>(step) * settings_.step; }

  SimulationSettings settings_;
  System system_;
  State state_;
  Vertices constant_force_, force_;
  std::unique_ptr<Integrator> integrator_;
  SpringNetwork springs_;
};

}  // namespace drape
