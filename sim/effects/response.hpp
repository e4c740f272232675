#pragma once

namespace drape {

/// How the push of a surface enters a step.
enum class Response {
  explicit_force,   ///< evaluated at the start of the step, as in the homework
  implicit_energy,  ///< part of what an implicit step minimises; semi-implicit Euler cannot have it
  solved            ///< a constraint with friction that a step of backward Euler solves for, see ContactSolver
};

}  // namespace drape
