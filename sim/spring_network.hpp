#pragma once

#include <array>
#include <vector>

#include "drape/sim/cloth.hpp"
#include "sim/parallel/loops.hpp"
#include "sim/parallel/threads.hpp"
#include "sim/parallel/vectors.hpp"

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

  /// Applies the springs in an explicit step: v += factor·(∇E(x) − force), then the drift.
  /// @param factor −h/m of each vertex, 0 on pins [s/kg]
  /// @param drift  with h = 0 to change the velocities only
  /// @returns Σ‖x‖², in no fixed order; not finite if any position is not [m²]
  double kick_and_drift(const Eigen::VectorXd& factor, const Vertices& force, const Drift& drift, Vertices& v,
                        Vertices& x) const;

  /// Returns the number of steps that kick_and_drift_times() takes at most; 1 if it does not pay.
  [[nodiscard]] int most_steps() const;
  /// Calls kick_and_drift() `count` times, with a drift `between` them, in one pass over the memory: each step follows
  /// the one before through the cache, as close as springs reach. Several threads take a share of the steps each. The
  /// bits are those of single steps.
  /// @param count up to most_steps()
  double kick_and_drift_times(int count, const Eigen::VectorXd& factor, const Vertices& force, const Drift& drift,
                              const Drift& between, Vertices& v, Vertices& x) const;

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
    double squares = 0;                   // Σ‖x‖² of its vertices after a kick [m²]
    Vertices at_lead = {}, at_tail = {};  // copies of positions from these vertices on, before other threads move them
  };
  /// Position of a stretch in a part; `leads` is true if it lies before the part.
  struct Place {
    int first;
    bool leads;
  };

  /// A pass over the stretches of a part in order, one at a time.
  class Pass {
   public:
    Pass(const SpringNetwork& network, Part& part);
    [[nodiscard]] bool over() const { return first_ >= part_->end; }
    /// Calls use(place, stretch) for the next stretch.
    template <class Use>
    void next(Use&& use);

   private:
    [[nodiscard]] double* column(const Band& b, int axis) const;

    const SpringNetwork* network_;
    Part* part_;
    int first_;                                    // vertex of the next stretch
    std::array<std::size_t, max_bands> places_{};  // of its forces in each band's scratch memory
  };

  static constexpr int most_at_once = 8;  // steps per pass

  void make_waves() const;
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
  mutable std::vector<Part> waves_;        // all vertices once per step of a pass, if several steps pay
  AlignedVector stiffness_, rest_length_;  // of the bands
  GatheredSprings gathered_;
  mutable std::vector<double> values_;  // per stretch, if there are several parts
  mutable Vertices other_force_;        // for explicit steps: the force plus that of springs outside of bands
};

/// Gives the springs of a grid with alternating or crossed diagonals the stiffnesses of an isotropic cloth, with
/// modulus E and a Poisson's ratio of 1/3. The springs along x, along y and the diagonals get the shares that achieve
/// this; stiffen_by_area uses the areas instead. Cells longer than √3 times their width would need pushing springs and
/// use stiffen_by_area.
/// @param modulus E, force per width and strain, positive [N/m]
/// @param cloth   whose rest shape is such a grid along x and y
void stiffen_evenly(double modulus, Cloth& cloth);

/// Stiffnesses of the springs of a course's cloth [N/m].
struct GridSprings {
  double structural;  ///< along the sides of cells
  double shear;       ///< along both diagonals of every cell
  double bend;        ///< between every other vertex of a row or column
};

/// Returns the springs of a course's cloth, sorted by vertices.
/// @param columns of the grid's cells
/// @param rest    its (columns + 1)·(rows + 1) vertices in row-major order, at least two rows
std::vector<Spring> springs_of_grid(int columns, const Vertices& rest, const GridSprings& stiffnesses);

}  // namespace drape
