#pragma once

#include <vector>

#include "sim/cloth.hpp"
#include "sim/kernels/vertices.hpp"

namespace drape {

/// Springs, E(x) = Σ k/2 (‖x_i − x_j‖ − L)², laid out for speed: a cloth's springs mostly join vertices that are a
/// fixed number apart (1, N+1 and N on an N×N grid), so they form long runs (i+t, j+t) whose vertices are read in
/// order. Short gaps in a run, as at the end of a grid's row, are filled with springs of zero stiffness.
class SpringNetwork {
 public:
  /// @param springs      any springs with i < j, duplicates included
  explicit SpringNetwork(const std::vector<Spring>& springs);

  /// E(x) [J].
  [[nodiscard]] double energy(const Vertices& x) const;

  /// gradient += ∇E(x), n×3 [N]. A spring of zero length pulls nowhere.
  void add_gradient(const Vertices& x, Vertices& gradient) const;
  /// The same in one pass with E(x) [J], which it returns.
  double add_value_gradient(const Vertices& x, Vertices& gradient) const;

  /// The springs' Hessian with its negative eigenvalues left out, one symmetric 3×3 block for each spring, d = xᵢ − xⱼ:
  ///   K = k max(0, 1 − L/‖d‖) I + k min(1, L/‖d‖) x̂x̂ᵀ = across·I + along·alongᵀ,
  /// which is the exact Hessian where the spring is stretched and k x̂x̂ᵀ where it is compressed.
  struct Blocks {
    Eigen::VectorXd across;  ///< one for each spring as it is laid out here [N/m]
    Vertices along;          ///< likewise [√(N/m)]
  };
  void compute_blocks(const Vertices& x, Blocks& blocks) const;

  /// product += H·vector, H the Hessian of the blocks: K on (i,i) and (j,j), −K on (i,j) and (j,i).
  void add_product(const Blocks& blocks, const Vertices& vector, Vertices& product) const;

  /// The springs as they were given, in the same order.
  [[nodiscard]] const std::vector<Spring>& springs() const { return springs_; }

 private:
  /// At most kernel_springs springs: a run from (first_i, first_j) if is_run, else a list.
  struct Block {
    bool is_run;
    int first_i, first_j;
    int begin, count;  // in stiffness_ and rest_length_, and for a list in i_ and j_
  };

  void add_run(const std::vector<Spring>& run);
  void add_lists(std::vector<Spring> rest);
  void append(const Spring& spring);
  [[nodiscard]] Eigen::Index stored() const { return static_cast<Eigen::Index>(stiffness_.size()); }
  [[nodiscard]] SpringRun run(const Block& block) const;
  [[nodiscard]] SpringList list(const Block& block) const;

  std::vector<Spring> springs_;
  std::vector<Block> blocks_;
  std::vector<int> i_, j_;
  std::vector<double> stiffness_, rest_length_;
};

}  // namespace drape
