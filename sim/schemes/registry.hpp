#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "sim/schemes/scheme.hpp"
#include "sim/schemes/stability_guard.hpp"
#include "sim/settings.hpp"

namespace drape {

/// What a method is made of.
struct MethodType {
  Method method;
  /// Refers to the system. @throws UsageError if something acts in it that the scheme cannot evaluate, or a matrix
  /// would not fit into memory or cannot be factored to working precision
  std::unique_ptr<Scheme> (*make)(const IntegratorSettings& settings, const System& system);
  std::unique_ptr<StabilityGuard> (*make_guard)(const IntegratorSettings& settings, const System& system);
};

/// The only list of what each method is.
const MethodType& method_type(Method method);

/// The guard of a motion with these settings, with an accuracy a SubstepGuard.
std::unique_ptr<StabilityGuard> make_guard(const SimulationSettings& settings, const System& system);

/// What takes the steps of a motion with these settings: the method's scheme, and nothing else unless an accuracy is
/// asked for; then a SubstepScheme.
/// @param guard of the motion @param make_system with steps of another length [s], for an accuracy
/// @throws UsageError as MethodType::make does
std::unique_ptr<Scheme> make_scheme(const SimulationSettings& settings, const System& system,
                                    const StabilityGuard& guard, const std::function<System(double step)>& make_system);

/// Why the motion cannot be computed with these settings, in a sentence: the step is beyond what the method's guard
/// allows. Nothing where it can.
std::optional<std::string> stability_problem(const SimulationSettings& settings, const System& system);

}  // namespace drape
