#include "sim/contact/contact_problem.hpp"

#include <cmath>
#include <utility>

#include "sim/parallel/vectors.hpp"

namespace drape {

ContactProblem::ContactProblem(const System& system, const StepObjective& objective, ConstantFactor& factor,
                               ImplicitHessian hessian)
    : system_(system), objective_(objective), factor_(factor), hessian_(hessian), bound_(system.stiffness_bound()) {
  diagonal_.setZero(objective.inertia().size(), 6);
  Eigen::VectorXd& sums = most_ = objective.inertia() + bound_.vertices;
  bound_.for_each_pair([&](const Spring& pair) {
    sums[pair.i] += std::max(0.0, pair.stiffness);
    sums[pair.j] += std::max(0.0, pair.stiffness);
  });
  for (const int axis : {0, 3, 5}) diagonal_.col(axis) = sums;
  if (hessian == ImplicitHessian::constant) return;
  for (const auto& energy : system.energies) hessians_.push_back(energy->make_hessian());
}

void ContactProblem::linearise(const Vertices& x, double concavity, double damping) {
  damping_ = damping;
  if (hessian_ == ImplicitHessian::constant) return;
  objective_.springs().compute_blocks(x, concavity, blocks_);
  diagonal_.setZero();
  for (const int axis : {0, 3, 5}) diagonal_.col(axis) = objective_.inertia();
  objective_.springs().add_diagonal(blocks_, diagonal_);
  for (const auto& hessian : hessians_) hessian->linearise(x, objective_.time(), concavity);
}

NewtonCholesky* ContactProblem::factor() {
  if (hessian_ == ImplicitHessian::constant) return nullptr;
  if (!newton_) newton_ = std::make_unique<NewtonCholesky>(system_, objective_);
  newton_->set_damping(damping_ * most_);
  return newton_.get();
}

double ContactProblem::stiffness(int vertex, const Eigen::Vector3d& u) const {
  const auto b = diagonal_.row(vertex);
  return b[0] * u[0] * u[0] + b[3] * u[1] * u[1] + b[5] * u[2] * u[2] +
         2 * (b[1] * u[0] * u[1] + b[2] * u[0] * u[2] + b[4] * u[1] * u[2]);
}

void ContactProblem::multiply(const Vertices& vector, Vertices& product) {
  weigh(objective_.threads(), objective_.inertia(), vector, product);
  if (hessian_ == ImplicitHessian::newton) {
    objective_.springs().add_product(blocks_, vector, product);
    for (const auto& hessian : hessians_) hessian->add_product(vector, product);
  } else {
    bound_.for_each_pair([&](const Spring& pair) {
      const Eigen::RowVector3d pull = pair.stiffness * (vector.row(pair.i) - vector.row(pair.j));
      product.row(pair.i) += pull;
      product.row(pair.j) -= pull;
    });
    product.array() += vector.array().colwise() * bound_.vertices.array();
  }
  if (damping_ > 0) product.array() += vector.array().colwise() * (damping_ * most_).array();
  for (const int pin : system_.cloth.pins) product.row(pin).setZero();
}

namespace {

using Index = std::size_t;

// Added to the unit diagonal of G to keep it positive definite when contacts are redundant.
constexpr double regularisation = 1e-6;

}  // namespace

ContactPreconditioner::ContactPreconditioner(int vertex_count) : at_vertex_(static_cast<Index>(vertex_count)) {}

void ContactPreconditioner::set(std::span<const ContactConstraint> contacts, std::vector<HeldDirection> held,
                                const std::vector<double>& inverse_masses) {
  held_ = std::move(held);
  for (const Row& row : rows_of_) {
    for (Index i = 0; i < static_cast<Index>(row.count); ++i) at_vertex_[static_cast<Index>(row.vertices[i])].clear();
  }
  rows_of_.clear();
  orthogonal_ = true;
  for (HeldDirection& held_row : held_) {
    const ContactConstraint& contact = contacts[static_cast<Index>(held_row.contact)];
    Row row{.count = 0, .vertices = {}, .entries = {}};
    double squared = 0;
    for (Index i = 0; i < static_cast<Index>(contact.count); ++i) {
      const auto vertex = static_cast<Index>(contact.vertices[i]);
      if (inverse_masses[vertex] == 0 || contact.weights[i] == 0) continue;
      row.vertices[static_cast<Index>(row.count)] = contact.vertices[i];
      row.entries[static_cast<Index>(row.count++)] = contact.weights[i] * held_row.direction;
      squared += contact.weights[i] * contact.weights[i];
    }
    const double length = std::sqrt(squared);
    for (Index i = 0; i < static_cast<Index>(row.count); ++i) {
      row.entries[i] /= length;
      std::vector<int>& rows = at_vertex_[static_cast<Index>(row.vertices[i])];
      if (!rows.empty() && held_[static_cast<Index>(rows.back())].contact != held_row.contact) orthogonal_ = false;
      rows.push_back(static_cast<int>(rows_of_.size()));
    }
    held_row.stiffness *= squared;
    rows_of_.push_back(row);
  }
  rows_.resize(std::ssize(held_));
  more_rows_.resize(std::ssize(held_));
  if (!orthogonal_) factorize();
}

void ContactPreconditioner::factorize() {
  std::vector<Eigen::Triplet<double>> entries;
  const int count = static_cast<int>(rows_of_.size());
  for (int a = 0; a < count; ++a) {
    const Row& row = rows_of_[static_cast<Index>(a)];
    entries.emplace_back(a, a, regularisation);
    for (Index i = 0; i < static_cast<Index>(row.count); ++i) {
      for (const int b : at_vertex_[static_cast<Index>(row.vertices[i])]) {
        if (b > a) continue;
        const Row& other = rows_of_[static_cast<Index>(b)];
        for (Index j = 0; j < static_cast<Index>(other.count); ++j) {
          if (other.vertices[j] == row.vertices[i]) entries.emplace_back(a, b, row.entries[i].dot(other.entries[j]));
        }
      }
    }
  }
  Eigen::SparseMatrix<double> matrix(count, count);
  matrix.setFromTriplets(entries.begin(), entries.end());
  factor_.compute(matrix);
}

void ContactPreconditioner::multiply(const Vertices& vector, Eigen::VectorXd& rows) const {
  for (Index k = 0; k < rows_of_.size(); ++k) {
    const Row& row = rows_of_[k];
    double sum = 0;
    for (Index i = 0; i < static_cast<Index>(row.count); ++i) sum += vector.row(row.vertices[i]).dot(row.entries[i]);
    rows[static_cast<Eigen::Index>(k)] = sum;
  }
}

void ContactPreconditioner::subtract_transposed(const Eigen::VectorXd& rows, Vertices& vector) const {
  for (Index k = 0; k < rows_of_.size(); ++k) {
    const Row& row = rows_of_[k];
    const double factor = rows[static_cast<Eigen::Index>(k)];
    for (Index i = 0; i < static_cast<Index>(row.count); ++i) {
      vector.row(row.vertices[i]) -= factor * row.entries[i].transpose();
    }
  }
}

void ContactPreconditioner::solve_rows(Eigen::VectorXd& rows) const {
  if (!orthogonal_) rows = factor_.solve(rows).eval();
}

}  // namespace drape
