#pragma once

#include <array>
#include <cstddef>

#include "sim/mesh.hpp"

namespace drape {

/// Anderson's acceleration of a fixed-point iteration c = T(c) (Walker and Ni 2011), n×3. The last few differences of
/// the residuals T(c) − c are kept orthonormal, and with each the difference of c that made it, so that the combination
/// whose residual is least follows from products with them (as in the GCR method, which this is where T is linear).
/// A residual that has grown is gone back from.
class AndersonHistory {
 public:
  /// @param unknowns n
  explicit AndersonHistory(Eigen::Index unknowns);

  /// Begins another iteration.
  void clear();
  /// Replaces c, whose residual is given, by where to go next. Returns false where it has gone back.
  bool advance(const Vertices& residual, Vertices& c);

 private:
  struct Pair {
    Vertices residual, c;  // differences
  };
  static constexpr std::size_t most_pairs = 12;

  /// Makes a pair of the last two points.
  void observe(const Vertices& residual, const Vertices& c);

  std::array<Pair, most_pairs> pairs_;
  std::size_t count_ = 0, oldest_ = 0;
  Vertices last_residual_, last_c_;  // of the last point, and of the one with the least residual…
  Vertices best_residual_, best_c_;  // …once begun_
  double best_ = 0;                  // the norm of its residual
  double length_ = 1;                // of a step from there, once it has been gone back to
  bool begun_ = false;
};

}  // namespace drape
