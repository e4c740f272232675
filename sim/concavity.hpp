#pragma once

#include <algorithm>

namespace drape {

// A spring of stiffness k, rest length L and length ‖d‖ has the Hessian K = k(1 − s)I + k s x̂x̂ᵀ with s = L/‖d‖. It is
// negative across the spring under compression. Curved bending has the same form. A minimisation keeps a fraction of
// the negative part, the concavity: 0 gives a positive semi-definite matrix, 1 the exact Hessian.

/// Upper limit of s; the Hessian of a more compressed spring holds nowhere else.
inline constexpr double most_compressed = 1000;

/// Returns the s for which K has this fraction of its negative part.
inline double share_across(double s, double concavity) {
  const double positive = std::min(s, 1.0);
  return positive + concavity * (std::min(s, most_compressed) - positive);
}

}  // namespace drape
