#pragma once

#include <vector>

#include "sim/cloth.hpp"
#include "sim/kernels/vertices.hpp"
#include "sim/parallel/incidence.hpp"
#include "sim/parallel/threads.hpp"

namespace drape {

/// Springs that are gathered by index, in the order of their vertices: all of an irregular mesh, and the few of a grid
/// that are in none of its bands (SpringNetwork).
///
/// One thread adds a spring's force to both of its vertices as soon as it has it. Several compute all forces first, and
/// then share the vertices, each of which adds up what it gets in the same order: the bits are the same, however the
/// mesh is numbered.
///
/// Keeps scratch memory: one object serves one thread.
class GatheredSprings {
 public:
  /// @param springs with i < j < vertex_count, duplicates included
  /// @param threads that share a pass, where it is long enough; they must outlive this
  GatheredSprings(std::vector<Spring> springs, int vertex_count, const Threads& threads);

  [[nodiscard]] std::size_t size() const { return i_.size(); }

  /// gradient += ∇E(x), n×3 [N]; the second returns E(x) [J], too.
  void add_gradient(const Vertices& x, Vertices& gradient) const;
  double add_value_gradient(const Vertices& x, Vertices& gradient) const;

  /// The springs' blocks in their order, as many as there are springs, see SpringNetwork.
  void compute_blocks(const Vertices& x, double concavity, SpringBlocks blocks) const;
  /// product += H·vector.
  void add_product(ConstSpringBlocks blocks, const Vertices& vector, Vertices& product) const;

  /// Calls use(spring, i, j) for all in their order.
  template <class Use>
  void for_each(Use&& use) const {
    for (std::size_t s = 0; s < i_.size(); ++s) use(static_cast<Eigen::Index>(s), i_[s], j_[s]);
  }

 private:
  /// The springs from one on that a kernel is given at once.
  [[nodiscard]] SpringList list(int first) const;
  [[nodiscard]] int lists() const;
  /// Calls use(list, its first spring, its number) for all lists, by all threads.
  template <class Use>
  void for_lists(Use&& use) const;
  /// Lets add(list, first spring, number) add the forces of every list to `to`, at once or by way of force_.
  template <class Add>
  void add_forces(Vertices& to, Add&& add) const;

  std::vector<int> i_, j_;
  std::vector<double, Eigen::aligned_allocator<double>> stiffness_, rest_length_;
  const Threads& threads_;              // one where there is too little to divide
  std::vector<int> first_;              // of each vertex, the first spring whose i it is, and where the last one's end
  Incidence last_;                      // of each vertex, the springs whose j it is
  mutable Vertices force_;              // of each spring, where several threads compute them
  mutable std::vector<double> values_;  // of each list
};

}  // namespace drape
