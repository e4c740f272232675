#pragma once

#include <vector>

#include "sim/cloth.hpp"
#include "sim/kernels/kernels.hpp"

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
  [[nodiscard]] SpringRun run(const Block& block) const;
  [[nodiscard]] SpringList list(const Block& block) const;

  std::vector<Spring> springs_;
  std::vector<Block> blocks_;
  std::vector<int> i_, j_;
  std::vector<double> stiffness_, rest_length_;
};

/// The columns of n×3 numbers, as the kernels take them.
inline Columns<const double> columns(const Vertices& v) { return {v.col(0).data(), v.col(1).data(), v.col(2).data()}; }
inline Columns<double> columns(Vertices& v) { return {v.col(0).data(), v.col(1).data(), v.col(2).data()}; }

}  // namespace drape
