#pragma once

#include <memory>
#include <vector>

#include "sim/linear/constant_factor.hpp"
#include "sim/linear/newton_cholesky.hpp"
#include "sim/solvers/minimiser.hpp"

namespace drape {

/// The function that a step minimises under contact, with a model of its Hessian.
class ContactProblem {
 public:
  virtual ~ContactProblem() = default;
  /// gradient = ∇g(x), n×3 and zero on pins [N]; returns g(x) [J].
  virtual double evaluate(const Vertices& x, Vertices& gradient) = 0;
  /// Takes the Hessian at x with a share of its negative eigenvalues, 0 to 1.
  /// @param damping added to it, of the largest stiffness that each vertex can have
  virtual void linearise(const Vertices& x, double concavity, double damping) = 0;
  /// Whether the Hessian is Newton's, so that a small step means that the minimum is near.
  [[nodiscard]] virtual bool exact() const = 0;
  /// A factor of H, damped as in linearise(), that also takes contacts which couple what H couples; null: none.
  [[nodiscard]] virtual NewtonCholesky* factor() { return nullptr; }
  /// product = H·vector, zero on pins.
  virtual void multiply(const Vertices& vector, Vertices& product) = 0;
  /// solution ≈ H⁻¹·vector, symmetric and positive definite over the free vertices, zero on pins.
  virtual void precondition(const Vertices& vector, Vertices& solution) = 0;
  /// Stiffness that holds a vertex by itself in a direction, where linearise() has been [N/m].
  [[nodiscard]] virtual double stiffness(int vertex, const Eigen::Vector3d& direction) const = 0;
  /// Error that rounding makes where g has this value [J].
  [[nodiscard]] virtual double rounding(double value) const = 0;
  /// Estimated distance of the worst vertex from the minimum, where the gradient is this [m].
  [[nodiscard]] virtual double error(const Vertices& gradient) const = 0;
};

/// A step of an implicit method, whose Hessian is Newton's without negative eigenvalues, or liu13's constant matrix.
class ImplicitProblem final : public ContactProblem {
 public:
  ImplicitProblem(const System& system, const StepObjective& objective, ConstantFactor& factor,
                  ImplicitHessian hessian);

  double evaluate(const Vertices& x, Vertices& gradient) override { return objective_.evaluate(x, gradient); }
  void linearise(const Vertices& x, double concavity, double damping) override;
  [[nodiscard]] bool exact() const override { return hessian_ == ImplicitHessian::newton; }
  [[nodiscard]] NewtonCholesky* factor() override;
  void multiply(const Vertices& vector, Vertices& product) override;
  void precondition(const Vertices& vector, Vertices& solution) override { factor_.solve(vector, solution); }
  [[nodiscard]] double stiffness(int vertex, const Eigen::Vector3d& direction) const override;
  [[nodiscard]] double rounding(double value) const override { return objective_.rounding(value); }
  [[nodiscard]] double error(const Vertices& gradient) const override { return objective_.error_bound(gradient); }

 private:
  const System& system_;
  const StepObjective& objective_;
  ConstantFactor& factor_;
  ImplicitHessian hessian_;
  Eigen::Matrix<double, Eigen::Dynamic, 6> diagonal_;  // blocks of H at vertices: xx, xy, xz, yy, yz, zz [N/m]
  HessianBlocks energies_;
  SpringNetwork::Blocks blocks_;
  Eigen::VectorXd most_;  // stiffness of each vertex [N/m]
  double damping_ = 0;
  std::unique_ptr<NewtonCholesky> newton_;  // once it is needed
  std::vector<std::unique_ptr<EnergyHessian>> hessians_;
  StiffnessBound bound_;  // of a constant Hessian: the energies' part
};

}  // namespace drape
