#pragma once

#include "sim/mesh.hpp"

namespace drape {

/// Solver of Newton's equations H(x) p = ∇g(x) over the free vertices. H is the Hessian of g with a fraction of its
/// negative eigenvalues (sim/concavity.hpp).
class NewtonSolver {
 public:
  virtual ~NewtonSolver() = default;

  /// Resets for another minimisation, so that earlier ones have no influence.
  virtual void begin() {}

  /// Computes a descent direction = H(x)⁻¹ gradient, n×3 and zero on pins. [N] → [m]
  /// Zero everywhere if H is not finite.
  /// @param concavity largest fraction; if H is not positive definite with it, a smaller one or only a part of H is
  ///                  used
  virtual void solve(const Vertices& x, const Vertices& gradient, double concavity, Vertices& direction) = 0;
};

}  // namespace drape
