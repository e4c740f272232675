#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace drape::audit {

__extension__ using Integer = __int128;

/// A polynomial with integer coefficients, the constant first, without leading zeros. Empty: zero.
using Integers = std::vector<Integer>;

Integers operator+(const Integers& a, const Integers& b);
Integers operator-(const Integers& a, const Integers& b);
Integers operator*(const Integers& a, const Integers& b);

/// A root of a polynomial: the only one in (low, low + 1) / 2^halvings, or low / 2^halvings itself if `exact`.
struct Root {
  Integer low = 0;
  int halvings = 0;
  bool exact = false;
};

/// Returns the distinct real roots of a polynomial in [0, 1], by Sturm's theorem.
/// @param p not zero, coefficients below some thousands, of degree 3 at most
std::vector<Root> roots_in_step(const Integers& p);

/// Returns the sign of q at a root of p: 0 for a common root; absent if 2⁻³⁶ does not separate their roots.
std::optional<int> sign_at(const Integers& q, const Root& root, const Integers& p);

}  // namespace drape::audit
