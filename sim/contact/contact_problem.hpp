#pragma once

#include <Eigen/Sparse>
#include <memory>
#include <span>
#include <vector>

#include "sim/contact/contact.hpp"
#include "sim/linear/constant_factor.hpp"
#include "sim/linear/newton_cholesky.hpp"
#include "sim/solvers/minimiser.hpp"

namespace drape {

/// Objective function g of an implicit step under contact, with a model H of its Hessian: Newton's without a share of
/// its negative eigenvalues, or liu13's constant matrix.
class ContactProblem {
 public:
  ContactProblem(const System& system, const StepObjective& objective, ConstantFactor& factor, ImplicitHessian hessian);

  /// Sets gradient = ∇g(x), n×3 and zero on pins [N]; returns g(x) [J].
  double evaluate(const Vertices& x, Vertices& gradient) { return objective_.evaluate(x, gradient); }
  /// Computes the Hessian at x with a share of its negative eigenvalues, 0 to 1.
  /// @param damping added to the diagonal, as a fraction of each vertex's largest possible stiffness
  void linearise(const Vertices& x, double concavity, double damping);
  /// Returns true for Newton's Hessian, where a small step means that the minimum is near.
  [[nodiscard]] bool exact() const { return hessian_ == ImplicitHessian::newton; }
  /// Returns a factor of H, damped as in linearise(), or null.
  [[nodiscard]] NewtonCholesky* factor();
  /// Makes the factor independent of the contacts of former steps.
  void forget_contacts() {
    if (newton_) newton_->forget_contacts();
  }
  /// Computes product = H·vector, zero on pins.
  void multiply(const Vertices& vector, Vertices& product);
  /// Computes solution ≈ H⁻¹·vector, symmetric positive definite over the free vertices, zero on pins.
  void precondition(const Vertices& vector, Vertices& solution) { factor_.solve(vector, solution); }
  /// Returns a vertex's own stiffness in a direction at the last linearise() [N/m].
  [[nodiscard]] double stiffness(int vertex, const Eigen::Vector3d& direction) const;
  /// Returns the rounding error of g at this value [J].
  [[nodiscard]] double rounding(double value) const { return objective_.rounding(value); }
  /// Returns the estimated distance of the worst vertex from the minimum at this gradient [m].
  [[nodiscard]] double error(const Vertices& gradient) const { return objective_.error_bound(gradient); }

 private:
  const System& system_;
  const StepObjective& objective_;
  ConstantFactor& factor_;
  ImplicitHessian hessian_;
  Eigen::Matrix<double, Eigen::Dynamic, 6> diagonal_;  // diagonal blocks of H: xx, xy, xz, yy, yz, zz [N/m]
  SpringNetwork::Blocks blocks_;
  Eigen::VectorXd most_;  // largest stiffness of each vertex [N/m]
  double damping_ = 0;
  std::unique_ptr<NewtonCholesky> newton_;  // created on first use
  std::vector<std::unique_ptr<EnergyHessian>> hessians_;
  StiffnessBound bound_;  // of a constant Hessian, the energies' part
};

/// One direction of a contact's relative position d that the contact constrains: a row u·d of the constraint Jacobian.
struct HeldDirection {
  int contact;
  Eigen::Vector3d direction;  ///< unit vector u
  double stiffness;           ///< stiffness along u, of contact and cloth together [N/m]
};

/// Preconditioner of H + Σ Jᵀ D J for conjugate gradients, built on a preconditioner of H. J holds the constrained rows
/// and Λ their stiffnesses. With G = J Jᵀ and S = I − Jᵀ G⁻¹ J, the projection on the unconstrained space,
///   P = S H⁻¹ S + Jᵀ G⁻¹ Λ⁻¹ G⁻¹ J.
/// Contacts far stiffer than the cloth decouple the two parts; the first then errs only near the constrained vertices.
/// A few iterations therefore suffice for any contact stiffness.
class ContactPreconditioner {
 public:
  explicit ContactPreconditioner(int vertex_count);

  /// Sets the constrained rows.
  /// @param inverse_masses see inverse_masses()
  void set(std::span<const ContactConstraint> contacts, std::vector<HeldDirection> held,
           const std::vector<double>& inverse_masses);

  /// Computes solution = P·vector, where solve(a, b) sets b = H⁻¹·a. The result is zero on pins if both inputs are.
  template <class Solve>
  void apply(const Vertices& vector, Vertices& solution, const Solve& solve) {
    if (held_.empty()) return solve(vector, solution);
    multiply(vector, rows_);
    solve_rows(rows_);
    free_part_ = vector;
    subtract_transposed(rows_, free_part_);
    solve(free_part_, solution);
    multiply(solution, more_rows_);
    solve_rows(more_rows_);
    subtract_transposed(more_rows_, solution);
    for (Eigen::Index k = 0; k < rows_.size(); ++k) rows_[k] /= -held_[static_cast<std::size_t>(k)].stiffness;
    solve_rows(rows_);
    subtract_transposed(rows_, solution);
  }

 private:
  void multiply(const Vertices& vector, Eigen::VectorXd& rows) const;
  void subtract_transposed(const Eigen::VectorXd& rows, Vertices& vector) const;
  void solve_rows(Eigen::VectorXd& rows) const;
  void factorize();

  struct Row {
    int count;
    std::array<int, 4> vertices;
    std::array<Eigen::Vector3d, 4> entries;  // of unit length together
  };

  std::vector<HeldDirection> held_;
  std::vector<Row> rows_of_;
  std::vector<std::vector<int>> at_vertex_;  // rows at each vertex, for assembling G
  bool orthogonal_ = true;                   // G is the identity: no two contacts share a vertex
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor_;
  Eigen::VectorXd rows_, more_rows_;
  Vertices free_part_;
};

}  // namespace drape
