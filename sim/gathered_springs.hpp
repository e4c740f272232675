#pragma once

#include <vector>

#include "sim/cloth.hpp"
#include "sim/kernels/vertices.hpp"
#include "sim/parallel/incidence.hpp"
#include "sim/parallel/threads.hpp"

namespace drape {

/// Springs accessed by index, sorted by their vertices: all springs of an irregular mesh, and those of a grid outside
/// its bands (SpringNetwork).
///
/// A single thread adds each spring's force to both vertices at once. Several threads first compute all forces. Each
/// then sums the forces at its share of the vertices in the same order. So the bits are the same for any numbering of
/// the mesh.
///
/// Keeps scratch memory: one object serves one thread.
class GatheredSprings {
 public:
  /// @param springs with i < j < vertex_count, duplicates included
  /// @param threads shared by a pass if it is long enough; must outlive this
  GatheredSprings(std::vector<Spring> springs, int vertex_count, const Threads& threads);

  [[nodiscard]] std::size_t size() const { return i_.size(); }

  /// Adds ∇E(x) to the gradient, n×3 [N]; the second function also returns E(x) [J].
  void add_gradient(const Vertices& x, Vertices& gradient) const;
  double add_value_gradient(const Vertices& x, Vertices& gradient) const;

  /// Computes the springs' blocks, one per spring in order, see SpringNetwork.
  void compute_blocks(const Vertices& x, double concavity, SpringBlocks blocks) const;
  /// Adds H·vector to the product.
  void add_product(ConstSpringBlocks blocks, const Vertices& vector, Vertices& product) const;

  /// Calls use(spring, i, j) for all springs in order.
  template <class Use>
  void for_each(Use&& use) const {
    for (std::size_t s = 0; s < i_.size(); ++s) use(static_cast<Eigen::Index>(s), i_[s], j_[s]);
  }

 private:
  /// Returns the list of springs from `first` on that one kernel call processes.
  [[nodiscard]] SpringList list(int first) const;
  [[nodiscard]] int lists() const;
  /// Calls use(list, its first spring, its number) for all lists, on all threads.
  template <class Use>
  void for_lists(Use&& use) const;
  /// Calls add(list, first spring, number) to add the forces of every list to `to`, directly or via force_.
  template <class Add>
  void add_forces(Vertices& to, Add&& add) const;

  std::vector<int> i_, j_;
  std::vector<double, Eigen::aligned_allocator<double>> stiffness_, rest_length_;
  const Threads& threads_;  // a single thread for few springs
  std::vector<int> first_;  // for each vertex, the first spring whose i it is; ends with the number of springs
  Incidence last_;          // for each vertex, the springs whose j it is
  mutable Vertices force_;  // per spring, if several threads compute them
  mutable std::vector<double> values_;  // per list
};

}  // namespace drape
