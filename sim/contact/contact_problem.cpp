#include "sim/contact/contact_problem.hpp"

#include <utility>

#include "sim/parallel/vectors.hpp"

namespace drape {

ImplicitProblem::ImplicitProblem(const System& system, const StepObjective& objective, ConstantFactor& factor,
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

void ImplicitProblem::linearise(const Vertices& x, double concavity, double damping) {
  damping_ = damping;
  if (hessian_ == ImplicitHessian::constant) return;
  objective_.springs().compute_blocks(x, concavity, blocks_);
  diagonal_.setZero();
  for (const int axis : {0, 3, 5}) diagonal_.col(axis) = objective_.inertia();
  objective_.springs().add_diagonal(blocks_, diagonal_);
  for (const auto& hessian : hessians_) hessian->linearise(x, objective_.time(), concavity);
}

NewtonCholesky* ImplicitProblem::factor() {
  if (hessian_ == ImplicitHessian::constant) return nullptr;
  if (!newton_) newton_ = std::make_unique<NewtonCholesky>(system_, objective_);
  newton_->set_damping(damping_ * most_);
  return newton_.get();
}

double ImplicitProblem::stiffness(int vertex, const Eigen::Vector3d& u) const {
  const auto b = diagonal_.row(vertex);
  return b[0] * u[0] * u[0] + b[3] * u[1] * u[1] + b[5] * u[2] * u[2] +
         2 * (b[1] * u[0] * u[1] + b[2] * u[0] * u[2] + b[4] * u[1] * u[2]);
}

void ImplicitProblem::multiply(const Vertices& vector, Vertices& product) {
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

}  // namespace drape
