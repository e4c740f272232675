#pragma once

#include "sim/mesh.hpp"

namespace drape {

/// Solves Newton's equations H(x) p = ∇g(x) over the free vertices, where H is the Hessian of g with a share of its
/// negative eigenvalues (sim/concavity.hpp).
class NewtonSolver {
 public:
  virtual ~NewtonSolver() = default;

  /// Begins the equations of another minimisation, on which nothing has an influence that was before it.
  virtual void begin() {}

  /// direction = H(x)⁻¹ gradient, n×3 and zero on pins, along which g falls. [N] → [m]
  /// Zero everywhere if H is not finite.
  /// @param concavity the share at most: where H is not positive definite with it, less or only a part of H counts
  virtual void solve(const Vertices& x, const Vertices& gradient, double concavity, Vertices& direction) = 0;
};

}  // namespace drape
