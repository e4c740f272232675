#pragma once

#include <array>
#include <optional>
#include <vector>

#include "sim/linear/free_vertices.hpp"
#include "sim/linear/multifrontal_cholesky.hpp"
#include "sim/linear/newton_solver.hpp"
#include "sim/step_objective.hpp"

namespace drape {

/// What a contact adds to a Hessian: weights[i]·weights[j]·stiffness for each pair of its vertices.
struct ContactBlock {
  int count = 1;
  std::array<int, 4> vertices = {};
  std::array<double, 4> weights = {};
  Eigen::Matrix3d stiffness;  ///< symmetric and positive semi-definite [N/m]
};

/// Newton's equations by a Cholesky factor of H = M/h² + Σ Kₛ, with one symmetric 3×3 block per spring and per pair of
/// vertices that an energy couples, and those of energies of single vertices on its diagonal. The sparsity is
/// analysed once, on the n×n graph of vertices; every assembly writes the values in place.
class NewtonCholesky final : public NewtonSolver {
 public:
  NewtonCholesky(const System& system, const StepObjective& objective);
  void begin() override { concavity_ = 1; }
  void solve(const Vertices& x, const Vertices& gradient, double concavity, Vertices& direction) override;

  /// Whether every two of these vertices that are free are coupled by springs or energies.
  [[nodiscard]] bool couples(const ContactBlock& block) const;
  /// Has H contain these from now on, all of which couple what H couples anyway.
  void set_contacts(std::vector<ContactBlock> contacts) { contacts_ = std::move(contacts); }
  /// Has H contain these on its diagonal, one for each vertex [N/m].
  void set_damping(Eigen::VectorXd damping) { damping_ = std::move(damping); }
  /// direction = H⁻¹ vector with the factor of the last solve().
  void solve_again(const Vertices& vector, Vertices& direction);
  /// Share of the negative eigenvalues in that factor.
  [[nodiscard]] double share() const { return share_; }

 private:
  /// Writes H.
  void assemble(const Vertices& x, double concavity);
  void add_energies(const Vertices& x, double concavity);
  void add_contacts();
  /// Factors H with the largest share that leaves it positive definite, among a few. Returns false where it is not
  /// finite.
  [[nodiscard]] bool factorize(const Vertices& x, double most);
  /// Factors what has been assembled without concavity.
  [[nodiscard]] bool factorize_positive();

  /// Where the block of a spring or a pair goes: the rows of its ends in H/3 (−1 for a pin), and the place of the
  /// off-diagonal block among those of the smaller row's column.
  struct Place {
    int low, high, rank;
  };

  /// Adds [K −K; −K K].
  void add(const Place& place, const Eigen::Matrix3d& block);
  void add_diagonal(int row, const Eigen::Matrix3d& block);
  void add_below(int column, int rank, const Eigen::Matrix3d& block);

  const System& system_;
  const StepObjective& objective_;
  /// Place of the block of two free rows among those of the smaller one's column; −1: none.
  [[nodiscard]] int rank_of(int low, int high) const;

  std::vector<ContactBlock> contacts_;
  Eigen::VectorXd damping_;  // of each vertex; empty: none [N/m]
  double share_ = 0;
  LowerPattern pattern_;            // of blocks
  std::vector<int> numbers_;        // of each vertex, its block row; −1: pinned
  double concavity_ = 1;            // that is tried next
  std::vector<int> vertices_;       // of each block row
  std::vector<Place> places_;       // of each spring, then of each pair of each energy
  std::vector<int> column_starts_;  // 3 per block row: where each scalar column begins in values_
  std::vector<double> values_;      // lower triangle of H
  std::vector<double> inertia_;     // m/h² of each block row
  std::vector<double> right_hand_side_;
  std::vector<std::unique_ptr<EnergyHessian>> hessians_;  // of the system's energies
  HessianBlocks blocks_;                                  // theirs
  std::optional<MultifrontalCholesky> factor_;            // none where everything is pinned
};

}  // namespace drape
