#pragma once

// Example:
//   drape::SimulationSettings settings{.step = 0.02};
//   settings.integrator = {.method = drape::Method::implicit, .scheme = drape::TimeScheme::sdirk2};
//   settings.effects.add(drape::Gravity{});

#include <array>
#include <optional>
#include <string_view>

#include "sim/cloth.hpp"
#include "sim/effects/effect.hpp"

namespace drape {

/// Method of a step.
enum class Method {
  semi_implicit,  ///< symplectic Euler: v += h·a(x), x += h·v
  implicit,       ///< steps minimised by Newton's method
  liu13,          ///< steps minimised by the local/global alternation of Liu et al. 2013
  quasi_newton,   ///< steps minimised by L-BFGS that starts from the matrix of Liu et al. 2013
  verlet,         ///< velocity Verlet: x += h/2·v, v += h·a(x), x += h/2·v
  automatic       ///< velocity Verlet in substeps, or quasi-Newton: see choose_method()
};

/// Number of methods that compute a step: all except `automatic`, which selects one of them.
inline constexpr std::size_t method_count = static_cast<std::size_t>(Method::automatic);

/// Returns true if a method computes a step from forces alone. It minimises nothing and has a largest stable step.
inline constexpr bool is_explicit(Method method) { return method == Method::semi_implicit || method == Method::verlet; }

/// Returns the name of an explicit method in a sentence.
inline constexpr std::string_view explicit_title(Method method) {
  return method == Method::verlet ? "velocity Verlet" : "semi-implicit Euler";
}

/// Time integration of an implicit method.
enum class TimeScheme {
  backward_euler,  ///< first order
  sdirk2           ///< second order, in two stages (Alexander 1977)
};

/// A method with its scheme, if it is implicit.
struct StepMethod {
  Method method = Method::liu13;
  TimeScheme scheme = TimeScheme::backward_euler;

  // Implicit: a method alone means backward Euler.
  constexpr StepMethod(Method m, TimeScheme s = TimeScheme::backward_euler) : method(m), scheme(s) {}
  bool operator==(const StepMethod&) const = default;
};

/// All methods with their schemes.
inline constexpr std::array step_methods{
    StepMethod{Method::semi_implicit},
    StepMethod{Method::implicit},
    StepMethod{Method::liu13},
    StepMethod{Method::quasi_newton},
    StepMethod{Method::verlet},
    StepMethod{Method::implicit, TimeScheme::sdirk2},
    StepMethod{Method::liu13, TimeScheme::sdirk2},
    StepMethod{Method::quasi_newton, TimeScheme::sdirk2},
};

/// Returns the order of convergence: the error of a motion falls with this power of the step.
inline constexpr int order_of(StepMethod how) {
  return how.method == Method::verlet || how.scheme == TimeScheme::sdirk2 ? 2 : 1;
}

/// Maximum number of substeps per step of an explicit method.
inline constexpr int most_substeps = 1 << 10;

/// Criterion for the accuracy of an iterative step.
enum class StoppingRule {
  change,    ///< 2-norm of the change of all unknowns below the tolerance [m], from the second iteration on
  gradient,  ///< ‖∇g‖, the 2-norm of the residual forces over all unknowns, below the tolerance [N]
  error      ///< estimated distance of the worst vertex from the exact minimiser below the tolerance [m]
};

/// Solver of Newton's equations.
enum class LinearSolver {
  automatic,           ///< the one that needs fewer operations, see CheaperNewton
  cholesky,            ///< a sparse direct factor
  conjugate_gradients  ///< preconditioned with Liu13's matrix
};

/// The scene's [integrator] table. A method ignores keys that it does not use.
struct IntegratorSettings {
  Method method = Method::automatic;
  TimeScheme scheme = TimeScheme::backward_euler;
  std::optional<StoppingRule> stop = {};  ///< absent: see Accuracy
  std::optional<double> tolerance = {};   ///< [m] or [N], see `stop`; absent: see Accuracy
  /// Absent: the homework's 20 for implicit and 100 for liu13, 500 for quasi_newton; 2000 with the error rule, except
  /// liu13.
  std::optional<int> max_iterations = {};
  LinearSolver linear_solver = LinearSolver::automatic;  ///< for the implicit method
  std::optional<int> substeps = {};  ///< per step of an explicit method; absent: 1, or chosen by the automatic method
  bool allow_unstable = false;       ///< run motions that stability_problem() rejects

  /// Returns the number of substeps per step without an accuracy.
  [[nodiscard]] int substep_count() const { return is_explicit(method) ? substeps.value_or(1) : 1; }

  [[nodiscard]] StepMethod step_method() const {
    return is_explicit(method) ? StepMethod(method) : StepMethod(method, scheme);
  }
};

/// Input of a simulation.
struct SimulationSettings {
  Cloth cloth = {};
  double step = 0.01;  ///< h [s]
  /// Limit of the error that a step adds to a vertex [m]; if set, it chooses the time scheme, see SubstepScheme.
  std::optional<double> accuracy = {};
  IntegratorSettings integrator = {};
  Effects effects = {};
  int threads = 1;             ///< shared by a step of a large cloth; any number gives the same bits
  bool spare_threads = false;  ///< fall back to one thread while the machine is busy; results do not change
};

}  // namespace drape
