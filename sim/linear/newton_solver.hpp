#pragma once

#include "sim/mesh.hpp"

namespace drape {

/// Solves Newton's equations H(x) p = ∇g(x) over the free vertices, where H is the Hessian of g with its springs'
/// negative eigenvalues left out, see SpringNetwork::Blocks.
class NewtonSolver {
 public:
  virtual ~NewtonSolver() = default;

  /// direction = H(x)⁻¹ gradient, n×3 and zero on pins. [N] → [m]
  /// Zero everywhere if H is not finite.
  virtual void solve(const Vertices& x, const Vertices& gradient, Vertices& direction) = 0;
};

}  // namespace drape
