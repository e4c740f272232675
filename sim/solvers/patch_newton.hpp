#pragma once

#include <vector>

#include "sim/parallel/incidence.hpp"
#include "sim/solvers/minimiser.hpp"
#include "sim/system.hpp"

namespace drape {

/// Newton's method on those patches of a cloth where the error is above a tolerance, while all around them stays where
/// it is: a block of a nonlinear Gauss-Seidel iteration, chosen where it is needed. Far from a minimum few vertices in
/// a hundred are strained so that the Hessian has little to do with A, and they keep methods for the whole cloth busy;
/// the Hessian of these alone is small enough to be factored. What is left is an error at the rims of patches, which
/// A⁻¹ spreads out.
///
/// For cloth that is held together by springs alone: no energy is asked for the part of it that a patch has.
class PatchNewton {
 public:
  /// Of all vertices, those that may be in patches with the memory that is asked for at first.
  static constexpr double usual_share = 0.25;

  /// @param objective of every step, which must outlive this
  /// @throws UsageError if the usual share would not fit into memory
  PatchNewton(const System& system, const StepObjective& objective);

  /// Lowers g by moving the vertices of the patches, which have vertices above the tolerance and those around them. A
  /// function of the point and the objective alone.
  /// @param share of all vertices that may be in patches, and never more than 200 000 of them; where there are more
  ///              nothing is done
  /// @param tolerance of the error of a vertex [m]
  /// @return how far they were moved [m], the 2-norm over all unknowns
  double settle(Iterate& point, double share, double tolerance);

 private:
  /// Of a vertex: outside of all patches, next to one, or in one.
  enum class Place : char { outside, rim, inside };

  /// Finds the patches, and their vertices with those of their rims.
  void find_patches(const Vertices& gradient, double tolerance);
  /// Appends all neighbours outside of the vertices from `first` on, which are then in that place.
  void surround(std::size_t first, Place place);
  /// The patches as a cloth whose pins are their rims, at rest at x.
  [[nodiscard]] Cloth cut_out(const Vertices& x);

  const System& system_;
  const StepObjective& objective_;
  Incidence springs_at_;       // of each vertex, its springs
  std::vector<Place> places_;  // of all vertices
  std::vector<int> vertices_;  // inside and on rims, ascending
  std::vector<int> numbers_;   // of those in vertices_
  std::size_t inside_ = 0;     // how many
};

}  // namespace drape
