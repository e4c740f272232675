#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "drape/sim/settings.hpp"
#include "sim/schemes/scheme.hpp"
#include "sim/schemes/stability_guard.hpp"

namespace drape {

/// Factories of a method.
struct MethodType {
  Method method;
  /// Makes the scheme, which refers to the system. @throws UsageError if the scheme cannot evaluate an effect, or a
  /// matrix does not fit into memory or cannot be factored to working precision
  std::unique_ptr<Scheme> (*make)(const IntegratorSettings& settings, const System& system);
  std::unique_ptr<StabilityGuard> (*make_guard)(const IntegratorSettings& settings, const System& system);
};

/// Returns the entry of the only list of methods.
const MethodType& method_type(Method method);

/// Returns the duration of a scheme's shortest minimisation as a fraction of the step.
double minimised_fraction(TimeScheme scheme);

/// Returns the guard for these settings; with an accuracy, a SubstepGuard.
std::unique_ptr<StabilityGuard> make_guard(const SimulationSettings& settings, const System& system);

/// Returns the scheme for these settings; with an accuracy, a SubstepScheme.
/// @param guard of the motion @param make_system makes a system with another step length [s], for an accuracy
/// @throws UsageError as MethodType::make does
std::unique_ptr<Scheme> make_scheme(const SimulationSettings& settings, const System& system,
                                    const StabilityGuard& guard, const std::function<System(double step)>& make_system);

/// Returns the reason, as a sentence, if the step exceeds the limit of the method's guard; otherwise nothing.
std::optional<std::string> stability_problem(const SimulationSettings& settings, const System& system);

}  // namespace drape
