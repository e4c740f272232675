#pragma once

#include <algorithm>

namespace drape {

// A spring of the stiffness k and the rest length L that is now ‖d‖ long has the Hessian K = k(1 − s)I + k s x̂x̂ᵀ, s =
// L/‖d‖: negative across it where it is compressed. Curved bending has the same form. Of what is negative a
// minimisation takes a share, the concavity: 0 leaves a positive semi-definite matrix everywhere, 1 is the exact
// Hessian.

/// Of s: springs that are compressed to less say nothing about anywhere else.
inline constexpr double most_compressed = 1000;

/// The s in whose place K has that share of what is negative.
inline double share_across(double s, double concavity) {
  const double positive = std::min(s, 1.0);
  return positive + concavity * (std::min(s, most_compressed) - positive);
}

}  // namespace drape
