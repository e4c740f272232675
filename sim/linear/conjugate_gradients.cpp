#include "sim/linear/conjugate_gradients.hpp"

#include <cmath>

namespace drape {
namespace {

// An iteration of Newton's method gains from a residual smaller than this only where it is about to converge to
// rounding; the iteration counts of the homework's tables are kept.
constexpr double tolerance = 1e-2;
// Far beyond what the worst scenes need. What is reached by then is still a direction of descent.
constexpr int max_iterations = 1000;

}  // namespace

ConjugateGradients::ConjugateGradients(const System& system, const StepObjective& objective,
                                       ConstantFactor* preconditioner)
    : system_(system),
      objective_(objective),
      own_(preconditioner == nullptr
               ? std::make_unique<ConstantFactor>(system, objective.duration(), Precision::automatic)
               : nullptr),
      preconditioner_(preconditioner == nullptr ? *own_ : *preconditioner),
      residual_(Vertices::Zero(system.cloth.vertex_count(), 3)),
      preconditioned_(residual_),
      search_(residual_),
      product_(residual_) {
  for (const auto& energy : system.energies) hessians_.push_back(energy->make_hessian());
}

void ConjugateGradients::solve(const Vertices& x, const Vertices& gradient, Vertices& direction) {
  const Kernels& k = kernels();
  const auto count = static_cast<std::size_t>(gradient.size());
  linearise(x);
  direction.setZero();
  residual_ = gradient;
  const double enough = tolerance * norm(gradient);
  double energy = 0;  // residual · A⁻¹ residual
  for (int iteration = 0; iteration < max_iterations && norm(residual_) > enough; ++iteration) {
    system_.stop.look();
    preconditioner_.solve(residual_, preconditioned_);
    const double before = energy;
    energy = dot(residual_, preconditioned_);
    if (iteration == 0) {
      search_ = preconditioned_;
    } else {
      search_ = preconditioned_ + (energy / before) * search_;
    }
    apply(search_, product_);
    const double length = energy / dot(search_, product_);
    if (!std::isfinite(length)) return;
    k.add_multiple(count, length, search_.data(), direction.data());
    k.add_multiple(count, -length, product_.data(), residual_.data());
  }
}

void ConjugateGradients::linearise(const Vertices& x) {
  objective_.springs().compute_blocks(x, blocks_);
  for (const auto& hessian : hessians_) hessian->linearise(x, objective_.time());
}

void ConjugateGradients::apply(const Vertices& vector, Vertices& product) const {
  product = vector.array().colwise() * objective_.inertia().array();
  objective_.springs().add_product(blocks_, vector, product);
  for (const auto& hessian : hessians_) hessian->add_product(vector, product);
  for (const int pin : system_.cloth.pins) product.row(pin).setZero();
}

}  // namespace drape
