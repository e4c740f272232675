#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "sim/cloth.hpp"
#include "sim/effects/effect.hpp"

namespace drape {

/// How a step is computed. The order is that of the names in a scene.
enum class Method {
  semi_implicit,  ///< symplectic Euler: v += h·a(x), x += h·v
  implicit,       ///< implicit Euler, minimised by Newton's method
  liu13,          ///< implicit Euler, minimised by the local/global alternation of Liu et al. 2013
  quasi_newton    ///< implicit Euler, minimised by L-BFGS that starts from the matrix of Liu et al. 2013
};

/// The methods as scenes write them, in the order of the enumeration.
inline constexpr std::array<std::string_view, 4> method_names{"semi-implicit", "implicit", "liu13", "quasi-newton"};

inline std::string method_name(Method method) { return std::string(method_names[static_cast<std::size_t>(method)]); }

/// When an iterative step is accurate enough.
enum class StoppingRule {
  change,  ///< the 2-norm of the change of all unknowns together is below the tolerance [m], from the second iteration
           ///< on
  gradient,  ///< ‖∇g‖, the 2-norm of the forces out of balance on all unknowns together, is below the tolerance [N]
  error      ///< the estimated distance of the worst vertex from the exact minimiser is below the tolerance [m]
};

/// The rules as scenes write them, in the order of the enumeration.
inline constexpr std::array<std::string_view, 3> stopping_rule_names{"change", "gradient", "error"};

inline std::string stopping_rule_name(StoppingRule rule) {
  return std::string(stopping_rule_names[static_cast<std::size_t>(rule)]);
}

/// How Newton's equations are solved.
enum class LinearSolver {
  automatic,           ///< conjugate gradients, the faster ones at every size and stiffness measured
  cholesky,            ///< a sparse direct factor
  conjugate_gradients  ///< preconditioned with Liu13's matrix
};

/// The scene's [integrator] table. Keys that a method does not use are ignored by it.
struct IntegratorSettings {
  Method method = Method::quasi_newton;
  std::optional<StoppingRule> stop;   ///< absent: see Accuracy
  std::optional<double> tolerance;    ///< [m] or [N], see `stop`; absent: see Accuracy
  std::optional<int> max_iterations;  ///< absent: the homework's 20 for implicit and 100 for liu13; 500 for
                                      ///< quasi_newton, 2000 where it stops at an error
  LinearSolver linear_solver = LinearSolver::automatic;  ///< of the implicit method
  bool allow_unstable = false;                           ///< run what stability_problem() refuses
};

/// Everything a simulation is made from.
struct SimulationSettings {
  Cloth cloth;
  double step = 0.01;  ///< h [s]
  IntegratorSettings integrator;
  Effects effects;
};

}  // namespace drape
