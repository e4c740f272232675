#pragma once

#include <span>
#include <vector>

#include "drape/sim/cloth.hpp"
#include "sim/bending/curvature.hpp"
#include "sim/spring_network.hpp"
#include "sim/system.hpp"

namespace drape {

/// Returns the pairs of vertices coupled by the elements, sorted, without duplicates. Each has the stiffness −Σ wᵢ wⱼ.
std::vector<Spring> curvature_pairs(std::span<const CurvatureElement> elements);

/// Bending energy of a cloth, E = ½ Σ (‖q‖ − r)² over the components of its curvature elements; r = 0 for most.
///
/// Its quadratic part ½ Σ ‖q‖² couples pairs of vertices like springs of zero length, E = Σ k/2 ‖xᵢ − xⱼ‖² with k = −Σ
/// wᵢ wⱼ of either sign, and is evaluated as such. For a flat rest shape it is the whole energy. Elsewhere it bounds
/// the Hessian, as the rest, r²/2 − r‖q‖, is concave.
class BendingEnergy final : public Energy {
 public:
  BendingEnergy(std::span<const CurvatureElement> elements, int vertex_count, const Threads& threads = one_thread());

  double add_gradient(const Vertices& x, double time, Vertices& gradient) const override;
  void add_bound(StiffnessBound& bound) const override;
  [[nodiscard]] std::unique_ptr<EnergyHessian> make_hessian() const override;

  /// Returns the pairs of vertices that it couples, sorted.
  [[nodiscard]] const std::vector<Spring>& pairs() const { return quadratic_.springs(); }

 private:
  friend class BendingHessian;

  /// A component with a nonzero rest curvature; its vertices are terms_[first] up to terms_[last], exclusive.
  struct Curved {
    std::size_t first, last;
    double rest;  // r [√J]
  };
  struct Term {
    int vertex;
    double weight;
  };

  [[nodiscard]] std::span<const Term> terms(const Curved& component) const {
    return std::span(terms_).subspan(component.first, component.last - component.first);
  }
  [[nodiscard]] Eigen::RowVector3d bent(const Curved& component, const Vertices& x) const;

  SpringNetwork quadratic_;
  std::vector<Curved> curved_;
  std::vector<Term> terms_;
};

/// An edge of a triangle.
struct EdgeSide {
  Edge edge;
  int triangle;
  int opposite;  ///< the triangle's third vertex
};

/// Returns every side of every triangle, sorted by edge and then by triangle, so that the sides of an edge are
/// consecutive. Triangles with a repeated vertex have none.
std::vector<EdgeSide> edge_sides(const std::vector<Triangle>& triangles);

/// Calls visit(side, next) for every side of every shared edge, with the next side around the edge: in both directions
/// for two triangles, in a ring for more. Omits sides with the same opposite vertex, as in duplicated triangles.
template <class Visit>
void for_neighbours(const std::vector<EdgeSide>& sides, Visit&& visit) {
  for (std::size_t first = 0, last = 0; first < sides.size(); first = last) {
    while (last < sides.size() && sides[last].edge == sides[first].edge) ++last;
    if (last - first < 2) continue;
    for (std::size_t s = first; s < last; ++s) {
      const EdgeSide& next = sides[s + 1 < last ? s + 1 : first];
      if (sides[s].opposite != next.opposite) visit(sides[s], next);
    }
  }
}

/// Returns the "cross" springs against bending, one between the vertices opposite to each edge shared by two triangles.
/// Their rest length is the distance in the rest shape. Sorted by vertices, without duplicates and without vertices
/// that an edge already joins.
/// @param stiffness of each [N/m]
std::vector<Spring> cross_springs(const Cloth& cloth, double stiffness);

}  // namespace drape
