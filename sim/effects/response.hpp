#pragma once

#include <optional>

namespace drape {

/// How contact enters a step.
enum class Response {
  explicit_force,   ///< a push that is evaluated at the start of the step, as in the homework
  implicit_energy,  ///< a push as part of what an implicit step minimises
  solved            ///< a constraint with friction, see ImpulseContact and ContactSolver
};

/// The response that is meant where none is named: explicit methods solve for contact by impulses; implicit ones push.
/// @param system_has_impulses whether the method is explicit
inline Response response_or_usual(const std::optional<Response>& named, bool system_has_impulses) {
  return named.value_or(system_has_impulses ? Response::solved : Response::explicit_force);
}

}  // namespace drape
