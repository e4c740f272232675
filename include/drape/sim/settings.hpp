#pragma once

// Example:
//   drape::SimulationSettings settings{.step = 0.02};
//   settings.integrator = {.method = drape::Method::implicit, .scheme = drape::TimeScheme::sdirk2};
//   settings.effects.add(drape::Gravity{});

// Example:
//   int patience = 1000;
//   const drape::Stop stop([&patience] { return --patience == 0; });
//   try {
//     for (;;) stop.check();
//   } catch (const drape::Interrupted&) {
//   }

// Example:
//   drape::limit_instruction_set("avx2");
//   std::printf("%s", drape::instruction_set().c_str());  // "sse2" where the processor has no AVX2

#include <array>
#include <exception>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "drape/sim/cloth.hpp"
#include "drape/sim/effects/effect.hpp"

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

/// Properties of a method that computes a step.
struct MethodTraits {
  std::string_view name;        ///< in scenes
  std::string_view title = {};  ///< of an explicit method, in a sentence
  int order = 0;                ///< order of convergence of an explicit method; 0: implicit, and of the scheme's order
};

/// The methods, in the order of the enumeration.
inline constexpr std::array<MethodTraits, method_count> method_traits{{
    {.name = "semi-implicit", .title = "semi-implicit Euler", .order = 1},
    {.name = "implicit"},
    {.name = "liu13"},
    {.name = "quasi-newton"},
    {.name = "verlet", .title = "velocity Verlet", .order = 2},
}};

/// @param method not `automatic`
inline constexpr const MethodTraits& traits_of(Method method) {
  return method_traits[static_cast<std::size_t>(method)];
}

/// Returns true if a method computes a step from forces alone. It minimises nothing and has a largest stable step.
inline constexpr bool is_explicit(Method method) { return method != Method::automatic && traits_of(method).order > 0; }

/// Time integration of an implicit method.
enum class TimeScheme {
  backward_euler,  ///< first order
  sdirk2           ///< second order, in two stages (Alexander 1977)
};

/// Properties of a time scheme.
struct SchemeTraits {
  std::string_view name;   ///< in scenes
  std::string_view title;  ///< in a sentence
  int order = 1;           ///< order of convergence
  int stages = 1;          ///< minimisations in a step
};

/// The time schemes, in the order of the enumeration; the first is the default.
inline constexpr std::array scheme_traits{
    SchemeTraits{.name = "backward-euler", .title = "backward Euler, first-order"},
    SchemeTraits{.name = "sdirk2", .title = "SDIRK2 (Alexander 1977), second-order", .order = 2, .stages = 2},
};

inline constexpr const SchemeTraits& traits_of(TimeScheme scheme) {
  return scheme_traits[static_cast<std::size_t>(scheme)];
}

/// A method with its scheme, if it is implicit.
struct StepMethod {
  Method method = Method::liu13;
  TimeScheme scheme = TimeScheme::backward_euler;

  // Implicit: a method alone means backward Euler.
  constexpr StepMethod(Method m = Method::liu13, TimeScheme s = TimeScheme::backward_euler) : method(m), scheme(s) {}
  bool operator==(const StepMethod&) const = default;
};

/// All methods with the first scheme, then the implicit ones with each other scheme.
inline constexpr auto step_methods = [] {
  constexpr std::size_t schemes = scheme_traits.size();
  constexpr auto exists = [](std::size_t k) {
    return k < method_count || !is_explicit(static_cast<Method>(k % method_count));
  };
  constexpr std::size_t count = [&] {
    std::size_t n = 0;
    for (std::size_t k = 0; k < schemes * method_count; ++k) n += exists(k) ? 1 : 0;
    return n;
  }();
  std::array<StepMethod, count> all;
  for (std::size_t k = 0, n = 0; k < schemes * method_count; ++k) {
    if (exists(k)) all[n++] = {static_cast<Method>(k % method_count), static_cast<TimeScheme>(k / method_count)};
  }
  return all;
}();

/// Returns the order of convergence: the error of a motion falls with this power of the step.
inline constexpr int order_of(StepMethod how) {
  return is_explicit(how.method) ? traits_of(how.method).order : traits_of(how.scheme).order;
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

/// Validates settings before a computation. The step must be positive, and every list of the cloth must have an entry
/// for each vertex (rest may be empty). Triangles, springs and pins must refer to existing vertices.
/// @throws UsageError with the expected and the found value
void require_valid(const SimulationSettings& settings);

/// Thrown by a computation that was told to stop. Not an error: there is nothing to report.
struct Interrupted final : std::exception {
  [[nodiscard]] const char* what() const noexcept override { return "interrupted"; }
};

/// A stop request that a computation checks between pieces of work of a few milliseconds. Library calls, such as a
/// sparse factorisation, run to their end between two checks.
class Stop {
 public:
  /// Creates an object that never stops.
  Stop() = default;
  /// @param asked returns true to stop; called on the computing thread, so it should be fast
  explicit Stop(std::function<bool()> asked)
      : asked_(std::make_shared<const std::function<bool()>>(std::move(asked))) {}

  /// Returns false if this object never stops.
  [[nodiscard]] bool possible() const { return asked_ != nullptr; }

  /// Checks for a stop request.
  /// @throws Interrupted if a stop is requested
  void check() const {
    if (asked_ && (*asked_)()) throw Interrupted();
  }

 private:
  std::shared_ptr<const std::function<bool()>> asked_;
};

/// Returns the instruction sets that the hot loops are compiled for, slowest first; some may not run here.
std::vector<std::string> instruction_sets();

/// Returns the instruction set in use: the fastest that this processor supports, within the limit.
std::string instruction_set();

/// Limits every simulation of the process to this instruction set; all sets give the same bits. Do not call while
/// another thread computes.
/// @throws UsageError if the name is unknown
void limit_instruction_set(std::string_view name);

}  // namespace drape
