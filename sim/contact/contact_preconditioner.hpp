#pragma once

#include <Eigen/Sparse>
#include <span>
#include <vector>

#include "sim/contact/contact.hpp"

namespace drape {

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
  /// @param free nonzero for vertices that can move
  void set(std::span<const ContactConstraint> contacts, std::vector<HeldDirection> held, const std::vector<char>& free);

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
