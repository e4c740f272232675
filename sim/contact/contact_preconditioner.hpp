#pragma once

#include <Eigen/Sparse>
#include <span>
#include <vector>

#include "sim/contact/contact.hpp"

namespace drape {

/// A direction of a contact's relative place d that the contact holds: a row u·d of the constraints' Jacobian.
struct HeldDirection {
  int contact;
  Eigen::Vector3d direction;  ///< u, of length 1
  double stiffness;           ///< that holds it, the contact's and the cloth's [N/m]
};

/// Preconditioner of H + Σ Jᵀ D J for conjugate gradients, from one of H alone. With J the rows that contacts hold,
/// G = J Jᵀ and S = I − Jᵀ G⁻¹ J, the projection on what they leave free,
///   P = S H⁻¹ S + Jᵀ G⁻¹ Λ⁻¹ G⁻¹ J,
/// Λ the stiffness of each row. Where contacts are far stiffer than the cloth the two parts do not mix, and the first
/// is off by the rim of what is held alone, so a few iterations do whatever the contacts' stiffness.
class ContactPreconditioner {
 public:
  explicit ContactPreconditioner(int vertex_count);

  /// Takes the rows that are held.
  /// @param free whether each vertex can move
  void set(std::span<const ContactConstraint> contacts, std::vector<HeldDirection> held, const std::vector<char>& free);

  /// solution = P·vector, where solve(a, b) sets b = H⁻¹·a. Zero on pins where both are.
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
  std::vector<std::vector<int>> at_vertex_;  // rows, where G has to be factored
  bool orthogonal_ = true;                   // no two contacts share a vertex: G is the identity
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor_;
  Eigen::VectorXd rows_, more_rows_;
  Vertices free_part_;
};

}  // namespace drape
