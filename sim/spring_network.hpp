#pragma once

#include <vector>

#include "sim/cloth.hpp"
#include "sim/gathered_springs.hpp"
#include "sim/kernels/vertices.hpp"
#include "sim/parallel/threads.hpp"

namespace drape {

/// Springs, E(x) = Σ k/2 (‖x_i − x_j‖ − L)², laid out for speed: a cloth's springs mostly join vertices that are a
/// fixed number apart (1, N and N+1 on an N×N grid). Each such offset is a band, with one entry for every vertex as in
/// a matrix stored by diagonals, and all bands are computed in one pass over the vertices, in order and without
/// indices. Where a band has no spring its entry has zero stiffness. Springs of rare offsets, and duplicates, are
/// gathered by index (GatheredSprings).
///
/// Several threads go over the bands in parts, one each, with the same bits as one: a part begins with the springs that
/// reach into it, which the part before it computes, too.
///
/// Keeps scratch memory: one network serves one thread.
class SpringNetwork {
 public:
  /// @param springs  any springs with i < j < vertex_count, duplicates included
  /// @param threads that share a pass, where it is long enough; they must outlive this
  SpringNetwork(const std::vector<Spring>& springs, int vertex_count, const Threads& threads = one_thread());

  /// gradient += ∇E(x), n×3 [N]; returns E(x) [J]. A spring of zero length pulls nowhere.
  double add_value_gradient(const Vertices& x, Vertices& gradient) const;

  /// gradient = ∇(E + Σ inertia/2 ‖x − y‖²)(x), n×3 [N]; returns the value of both [J].
  /// @param inertia one for each vertex [N/m]
  double evaluate(const Eigen::VectorXd& inertia, const Vertices& y, const Vertices& x, Vertices& gradient) const;

  /// The springs' part of an explicit step: v += factor·(∇E(x) − force), then x += h·v.
  /// @param factor −h/m of each vertex, 0 on pins [s/kg]
  /// @param h      0 to change the velocities only [s]
  void kick_and_drift(const Eigen::VectorXd& factor, const Vertices& force, double h, Vertices& v, Vertices& x) const;

  /// The springs' Hessian, one symmetric 3×3 block for each spring, d = xᵢ − xⱼ:
  ///   K = k (1 − s) I + k s x̂x̂ᵀ = across·I + along·alongᵀ,  s = share_across(L/‖d‖, concavity).
  /// Without concavity that is exact where the spring is stretched and k x̂x̂ᵀ where it is compressed.
  struct Blocks {
    Eigen::VectorXd across;  ///< one for each spring as it is laid out here [N/m]
    Vertices along;          ///< likewise [√(N/m)]
  };
  void compute_blocks(const Vertices& x, double concavity, Blocks& blocks) const;

  /// product += H·vector, H the Hessian of the blocks: K on (i,i) and (j,j), −K on (i,j) and (j,i).
  void add_product(const Blocks& blocks, const Vertices& vector, Vertices& product) const;

  /// diagonal += the 3×3 blocks at the vertices of H without its springs' negative eigenvalues: xx, xy, xz, yy, yz, zz,
  /// n×6 [N/m].
  void add_diagonal(const Blocks& blocks, Eigen::Matrix<double, Eigen::Dynamic, 6>& diagonal) const;

  /// How many springs are in no band.
  [[nodiscard]] std::size_t gathered() const { return gathered_.size(); }
  /// The springs as they were given, in the same order.
  [[nodiscard]] const std::vector<Spring>& springs() const { return springs_; }

 private:
  // Vectors that begin where cache lines begin are read twice as fast.
  using AlignedVector = std::vector<double, Eigen::aligned_allocator<double>>;

  struct Band {
    int offset;
    std::size_t begin;    // of its entries in stiffness_ and rest_length_, one for each vertex
    std::size_t scratch;  // of its forces in Part::force: three columns of `capacity`
    std::size_t lead, capacity;
  };
  /// The vertices from first to end, which one thread goes over, and its memory.
  struct Part {
    int first = 0, end = 0;
    int lead = 0;                         // where it begins to compute springs
    int tail = 0;                         // the first of those vertices whose stretch has springs to the next part
    AlignedVector force = {};             // of the springs of each band, for as long as the pass needs them
    Vertices nowhere = {};                // takes what a pass writes for vertices before the first
    Vertices at_lead = {}, at_tail = {};  // where vertices are, beginning with these, before anybody moves them
  };
  /// A stretch of a part: where it is, and whether it only leads up to the part.
  struct Place {
    int first;
    bool leads;
  };

  void find_bands();
  /// Finds the bands and gives them their springs; returns the others.
  std::vector<Spring> fill_bands();
  void cut_parts();
  [[nodiscard]] SpringBand band(const Band& band, int first, double* force) const;
  /// Calls use(place, stretch) for all stretches of a part in order.
  template <class Use>
  void for_stretches(Part& part, Use&& use) const;
  /// The same for all parts, with use(place, stretch, columns of `to` for it).
  template <class Use>
  void for_all_stretches(Vertices& to, Use&& use) const;
  /// The sum of the values that use() returns for stretches, in their order.
  template <class Use>
  double sum_over_stretches(Vertices& to, Use&& use) const;
  /// Keeps what other parts' threads are about to move, see Part.
  void keep_surroundings(Part& part, const Vertices& x) const;

  std::vector<Spring> springs_;
  int vertex_count_;
  std::vector<Band> bands_;  // by offset
  const Threads& threads_;
  mutable std::vector<Part> parts_;
  AlignedVector stiffness_, rest_length_;  // of the bands
  GatheredSprings gathered_;
  mutable std::vector<double> values_;  // of every stretch, where there is more than one part
  mutable Vertices other_force_;        // of an explicit step, with that of springs in no band
};

}  // namespace drape
