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

/// How a step is computed.
enum class Method {
  semi_implicit,  ///< symplectic Euler: v += h·a(x), x += h·v
  implicit,       ///< steps minimised by Newton's method
  liu13,          ///< steps minimised by the local/global alternation of Liu et al. 2013
  quasi_newton,   ///< steps minimised by L-BFGS that starts from the matrix of Liu et al. 2013
  verlet,         ///< velocity Verlet: x += h/2·v, v += h·a(x), x += h/2·v
  automatic       ///< velocity Verlet in substeps, or quasi-Newton: see choose_method()
};

/// How many methods there are that compute a step: all but `automatic`, which stands for one of them.
inline constexpr std::size_t method_count = static_cast<std::size_t>(Method::automatic);

/// Whether a method computes a step from the forces alone: it minimises nothing, and has a largest stable step.
inline constexpr bool is_explicit(Method method) { return method == Method::semi_implicit || method == Method::verlet; }

/// What an explicit method is called in a sentence.
inline constexpr std::string_view explicit_title(Method method) {
  return method == Method::verlet ? "velocity Verlet" : "semi-implicit Euler";
}

/// The time integration of an implicit method.
enum class TimeScheme {
  backward_euler,  ///< of first order
  sdirk2           ///< of second order, in two stages (Alexander 1977)
};

/// A method and, if it is implicit, its scheme: together they have a name.
struct StepMethod {
  Method method = Method::liu13;
  TimeScheme scheme = TimeScheme::backward_euler;

  // Implicit: a method alone is meant with backward Euler.
  constexpr StepMethod(Method m, TimeScheme s = TimeScheme::backward_euler) : method(m), scheme(s) {}
  bool operator==(const StepMethod&) const = default;
};

/// All of them.
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

/// The order of convergence: the error of a motion falls with this power of the step.
inline constexpr int order_of(StepMethod how) {
  return how.method == Method::verlet || how.scheme == TimeScheme::sdirk2 ? 2 : 1;
}

/// The most substeps that an explicit method can cut a step into.
inline constexpr int most_substeps = 1 << 10;

/// When an iterative step is accurate enough.
enum class StoppingRule {
  change,  ///< the 2-norm of the change of all unknowns together is below the tolerance [m], from the second iteration
           ///< on
  gradient,  ///< ‖∇g‖, the 2-norm of the forces out of balance on all unknowns together, is below the tolerance [N]
  error      ///< the estimated distance of the worst vertex from the exact minimiser is below the tolerance [m]
};

/// How Newton's equations are solved.
enum class LinearSolver {
  automatic,           ///< conjugate gradients, or the factor where it takes fewer operations, see CheaperNewton
  cholesky,            ///< a sparse direct factor
  conjugate_gradients  ///< preconditioned with Liu13's matrix
};

/// The scene's [integrator] table. A method ignores the keys that it does not use.
struct IntegratorSettings {
  Method method = Method::automatic;
  TimeScheme scheme = TimeScheme::backward_euler;
  std::optional<StoppingRule> stop = {};   ///< absent: see Accuracy
  std::optional<double> tolerance = {};    ///< [m] or [N], see `stop`; absent: see Accuracy
  std::optional<int> max_iterations = {};  ///< absent: the homework's 20 for implicit and 100 for liu13; 500 for
                                           ///< quasi_newton; both but liu13 2000 where they stop at an error
  LinearSolver linear_solver = LinearSolver::automatic;  ///< of the implicit method
  std::optional<int> substeps = {};  ///< that an explicit method cuts each step into; absent: 1, or what is chosen
                                     ///< with an automatic method
  bool allow_unstable = false;       ///< run what stability_problem() refuses

  /// How many substeps a step has that is not cut by an accuracy.
  [[nodiscard]] int substep_count() const { return is_explicit(method) ? substeps.value_or(1) : 1; }

  [[nodiscard]] StepMethod step_method() const {
    return is_explicit(method) ? StepMethod(method) : StepMethod(method, scheme);
  }
};

/// Everything a simulation is made from.
struct SimulationSettings {
  Cloth cloth = {};
  double step = 0.01;  ///< h [s]
  std::optional<double> accuracy =
      {};  ///< the most that a step may add to the error of a vertex [m], see SubstepScheme: it chooses the time scheme
  IntegratorSettings integrator = {};
  Effects effects = {};
  int threads = 1;  ///< that share a step where the cloth is large; the motion has the same bits with any number
  bool spare_threads = false;  ///< do without all but one for a while where the machine is busy; the bits stay
};

}  // namespace drape
