#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "sim/linear/multifrontal_cholesky.hpp"
#include "sim/linear/newton_solver.hpp"
#include "sim/linear/sparse_cholesky.hpp"
#include "sim/step_objective.hpp"

namespace drape {

/// Contribution of a contact to a Hessian: weights[i]·weights[j]·stiffness for each pair of its vertices.
struct ContactBlock {
  int count = 1;
  std::array<int, 4> vertices = {};
  std::array<double, 4> weights = {};
  Eigen::Matrix3d stiffness;  ///< symmetric and positive semi-definite [N/m]
};

/// Solver of Newton's equations by a Cholesky factor of H = M/h² + Σ Kₛ. There is one symmetric 3×3 block per spring
/// and per pair of vertices coupled by an energy; energies of single vertices add to the diagonal. The sparsity is
/// analysed on the n×n graph of vertices, once, and again when contacts couple other vertices; each assembly writes the
/// values in place. An energy's product, which couples all vertices, stays outside the factor: each costs one more
/// solve per factor.
class NewtonCholesky final : public NewtonSolver {
 public:
  NewtonCholesky(const System& system, const StepObjective& objective);
  void begin() override { concavity_ = 1; }
  void solve(const Vertices& x, const Vertices& gradient, double concavity, Vertices& direction) override;

  /// Adds contacts to H from now on, and widens its pattern if they couple other vertices.
  /// @returns false if that factor would be too expensive: contacts are then left out until forget_contacts()
  [[nodiscard]] bool set_contacts(std::vector<ContactBlock> contacts);
  /// Forgets the couplings of former contacts at the next set_contacts(), so that a factor depends on its step alone.
  void forget_contacts() { forgets_ = true; }
  /// Adds these to the diagonal of H, one per vertex [N/m].
  void set_damping(Eigen::VectorXd damping) { damping_ = std::move(damping); }

 private:
  /// Returns the index of the block of two free rows in the column of the smaller one; −1: none.
  [[nodiscard]] int rank_of(int low, int high) const;
  /// Calls visit(low, high) for every two free rows of a contact.
  template <class Visit>
  void for_each_pair(const ContactBlock& block, const Visit& visit) const;
  /// Returns true if the pattern of H has a block for every two free vertices of the contact.
  [[nodiscard]] bool couples(const ContactBlock& block) const;
  /// Widens the pattern by those of the contacts; returns false if the factor would be too expensive.
  bool widen_pattern();
  /// Makes this the pattern of H, and lays out its values and its factor.
  /// @param order of the block rows, with little fill
  /// @throws UsageError, see MultifrontalCholesky
  void lay_out(LowerPattern pattern, const std::vector<int>& order);
  /// Lays out the pattern of springs and energies.
  void lay_out_plainly();
  /// Computes direction = H⁻¹ vector with the factor of the last factorize().
  void solve_factored(const Vertices& vector, Vertices& direction);
  /// Assembles H.
  void assemble(const Vertices& x, double concavity);
  void add_energies(const Vertices& x, double concavity);
  void add_contacts();
  /// Factors H with the largest of a few concavities for which it is positive definite. Returns false if H is not
  /// finite.
  [[nodiscard]] bool factorize(const Vertices& x, double most);
  /// Factors the matrix assembled without concavity.
  [[nodiscard]] bool factorize_positive();
  /// Finds the effect of the energies' products on a solution with the factor.
  void solve_products();
  /// Corrects the first `count` products' effect on right_hand_side_, which holds a solution with the factor.
  void correct_for_products(std::size_t count);
  /// Returns a·v of a product's direction a, with v in right_hand_side_.
  [[nodiscard]] double along(const HessianProduct& product) const;

  /// Position of the block of a spring or a pair: the block rows of its ends (−1 for a pin), and the index of the
  /// off-diagonal block in the column of the smaller row.
  struct Place {
    int low, high, rank;
  };

  /// Adds [K −K; −K K] with a symmetric K.
  void add(const Place& place, const Eigen::Matrix3d& block);
  /// Adds [K' −K; −Kᵀ K'] with the symmetric part K' of any K.
  void add_pair(const Place& place, const Eigen::Matrix3d& block);
  void add_diagonal(int row, const Eigen::Matrix3d& block);
  void add_below(int column, int rank, const Eigen::Matrix3d& block);

  const System& system_;
  const StepObjective& objective_;
  std::vector<ContactBlock> contacts_;
  Eigen::VectorXd damping_;         // per vertex; empty: none [N/m]
  LowerPattern plain_;              // pattern of springs and energies, in blocks
  LowerPattern pattern_;            // that of the factor
  bool forgets_ = false;            // true if the next widening starts from plain_
  bool too_wide_ = false;           // true if the contacts' couplings make the factor too expensive
  std::vector<int> numbers_;        // block row of each vertex; −1: pinned
  double concavity_ = 1;            // next concavity to try
  std::vector<int> vertices_;       // vertex of each block row
  std::vector<Place> places_;       // per spring, then per pair of each energy
  std::vector<int> column_starts_;  // 3 per block row: start of each scalar column in values_
  std::vector<double> values_;      // lower triangle of H
  std::vector<double> inertia_;     // m/h² per block row
  std::vector<double> right_hand_side_;
  std::vector<std::unique_ptr<EnergyHessian>> hessians_;  // of the system's energies
  HessianBlocks blocks_;                                  // of hessians_
  std::optional<MultifrontalCholesky> factor_;            // none if everything is pinned

  /// A product s a aᵀ of the energies, which is not in the factor (Sherman and Morrison 1950).
  struct Update {
    std::vector<double> solution;  // H⁻¹ a with the products before this one
    double scale;                  // s/(1 + s a·solution)
  };
  std::vector<Update> updates_;  // one per product of blocks_
};

/// Solver of Newton's equations by conjugate gradients while these take less work than a factor of H. Work is counted
/// in operations, so the choice is the same on every machine. Each minimisation begins with conjugate gradients. It
/// keeps to them if the factor is rejected, for lack of memory or because the mesh is unlike a surface.
class CheaperNewton final : public NewtonSolver {
 public:
  CheaperNewton(const System& system, const StepObjective& objective);
  void begin() override;
  void solve(const Vertices& x, const Vertices& gradient, double concavity, Vertices& direction) override;

  /// Returns true if the factor solved the last equations.
  [[nodiscard]] bool factors() const { return factors_; }

 private:
  /// Makes the factor if possible; returns true if there is one.
  [[nodiscard]] bool make_factor();

  const System& system_;
  const StepObjective& objective_;
  ConjugateGradients iterated_;
  int patience_;                              // number of iterations that cost as much as a factor
  std::unique_ptr<NewtonCholesky> factored_;  // created on first use
  bool factors_ = false, refused_ = false;
};

}  // namespace drape
