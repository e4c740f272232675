#pragma once

#include <vector>

#include "sim/cloth.hpp"
#include "sim/gathered_springs.hpp"
#include "sim/kernels/vertices.hpp"
#include "sim/parallel/threads.hpp"

namespace drape {

/// Springs, E(x) = Σ k/2 (‖x_i − x_j‖ − L)², in a layout for speed. Most springs of a cloth join vertices at a fixed
/// offset in number (1, N and N+1 on an N×N grid). Each offset forms a band with one entry per vertex, like a matrix
/// stored by diagonals. All bands are computed in one ordered pass over the vertices, without indices. Entries without
/// a spring have zero stiffness. Springs with rare offsets, and duplicates, are accessed by index (GatheredSprings).
///
/// Several threads each process one part of the bands and give the same bits as one. A part also computes the springs
/// that reach into it from the part before.
///
/// Keeps scratch memory: one network serves one thread.
class SpringNetwork {
 public:
  /// @param springs  any springs with i < j < vertex_count, duplicates included
  /// @param threads shared by a pass if it is long enough; must outlive this
  SpringNetwork(const std::vector<Spring>& springs, int vertex_count, const Threads& threads = one_thread());

  /// Adds ∇E(x) to the gradient, n×3 [N]; returns E(x) [J]. A spring of zero length exerts no force.
  double add_value_gradient(const Vertices& x, Vertices& gradient) const;

  /// Sets gradient = ∇(E + Σ inertia/2 ‖x − y‖²)(x), n×3 [N]; returns the value of both terms [J].
  /// @param inertia per vertex [N/m]
  double evaluate(const Eigen::VectorXd& inertia, const Vertices& y, const Vertices& x, Vertices& gradient) const;

  /// Applies the springs in an explicit step: v += factor·(∇E(x) − force), then x += h·v.
  /// @param factor −h/m of each vertex, 0 on pins [s/kg]
  /// @param h      0 to change the velocities only [s]
  void kick_and_drift(const Eigen::VectorXd& factor, const Vertices& force, double h, Vertices& v, Vertices& x) const;

  /// Hessian of the springs, one symmetric 3×3 block per spring, with d = xᵢ − xⱼ:
  ///   K = k (1 − s) I + k s x̂x̂ᵀ = across·I + along·alongᵀ,  s = share_across(L/‖d‖, concavity).
  /// With concavity 0 it is exact for stretched springs and k x̂x̂ᵀ for compressed ones.
  struct Blocks {
    Eigen::VectorXd across;  ///< one per entry of this layout [N/m]
    Vertices along;          ///< one per entry [√(N/m)]
  };
  void compute_blocks(const Vertices& x, double concavity, Blocks& blocks) const;

  /// Adds H·vector to the product, with H from the blocks: K on (i,i) and (j,j), −K on (i,j) and (j,i).
  void add_product(const Blocks& blocks, const Vertices& vector, Vertices& product) const;

  /// Adds the 3×3 diagonal blocks of H, without negative eigenvalues of its springs: xx, xy, xz, yy, yz, zz, n×6 [N/m].
  void add_diagonal(const Blocks& blocks, Eigen::Matrix<double, Eigen::Dynamic, 6>& diagonal) const;

  /// Returns the number of springs outside of bands.
  [[nodiscard]] std::size_t gathered() const { return gathered_.size(); }
  /// Returns the springs in the order given.
  [[nodiscard]] const std::vector<Spring>& springs() const { return springs_; }

 private:
  // Vector aligned to cache lines, which is read twice as fast.
  using AlignedVector = std::vector<double, Eigen::aligned_allocator<double>>;

  struct Band {
    int offset;
    std::size_t begin;    // of its entries in stiffness_ and rest_length_, one per vertex
    std::size_t scratch;  // of its forces in Part::force: three columns of `capacity`
    std::size_t lead, capacity;
  };
  /// Vertices from first to end for one thread, and its scratch memory.
  struct Part {
    int first = 0, end = 0;
    int lead = 0;                         // first vertex whose springs it computes
    int tail = 0;                         // start of the first stretch with springs to the next part
    AlignedVector force = {};             // forces of the springs of each band, while needed in a pass
    Vertices nowhere = {};                // receives results for vertices before the first
    Vertices at_lead = {}, at_tail = {};  // copies of positions from these vertices on, before other threads move them
  };
  /// Position of a stretch in a part; `leads` is true if it lies before the part.
  struct Place {
    int first;
    bool leads;
  };

  void find_bands();
  /// Finds the bands and fills in their springs; returns the others.
  std::vector<Spring> fill_bands();
  void cut_parts();
  [[nodiscard]] SpringBand band(const Band& band, int first, double* force) const;
  /// Calls use(place, stretch) for all stretches of a part in order.
  template <class Use>
  void for_stretches(Part& part, Use&& use) const;
  /// Calls use(place, stretch, columns of `to` for it) for all stretches of all parts.
  template <class Use>
  void for_all_stretches(Vertices& to, Use&& use) const;
  /// Returns the sum of use() over all stretches, in their order.
  template <class Use>
  double sum_over_stretches(Vertices& to, Use&& use) const;
  /// Copies the positions that other threads are about to move, see Part.
  void keep_surroundings(Part& part, const Vertices& x) const;

  std::vector<Spring> springs_;
  int vertex_count_;
  std::vector<Band> bands_;  // sorted by offset
  const Threads& threads_;
  mutable std::vector<Part> parts_;
  AlignedVector stiffness_, rest_length_;  // of the bands
  GatheredSprings gathered_;
  mutable std::vector<double> values_;  // per stretch, if there are several parts
  mutable Vertices other_force_;        // for explicit steps: the force plus that of springs outside of bands
};

}  // namespace drape
