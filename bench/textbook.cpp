#include "bench/textbook.hpp"

#include <Eigen/Sparse>
#include <algorithm>
#include <cmath>
#include <cstddef>

namespace drape::textbook {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using SparseMatrix = Eigen::SparseMatrix<double>;
using Triplets = std::vector<Eigen::Triplet<double>>;

Vector3d between(const MatrixXd& x, const Spring& spring) { return x.row(spring.i) - x.row(spring.j); }

/// Converts n×3 to 3n: x₀ y₀ z₀ x₁ y₁ z₁ …
VectorXd flatten(const MatrixXd& x) {
  const MatrixXd transposed = x.transpose();
  return Eigen::Map<const VectorXd>(transposed.data(), transposed.size());
}

MatrixXd unflatten(const VectorXd& x) { return Eigen::Map<const MatrixXd>(x.data(), 3, x.size() / 3).transpose(); }

/// Returns S with x_free = S x, for the 3n coordinates.
SparseMatrix selection_matrix(const std::vector<bool>& pinned) {
  Triplets triplets;
  int row = 0;
  for (int vertex = 0; vertex < static_cast<int>(pinned.size()); ++vertex) {
    if (pinned[static_cast<std::size_t>(vertex)]) continue;
    for (int axis = 0; axis < 3; ++axis) triplets.emplace_back(row++, 3 * vertex + axis, 1.0);
  }
  SparseMatrix selection(row, 3 * static_cast<Index>(pinned.size()));
  selection.setFromTriplets(triplets.begin(), triplets.end());
  return selection;
}

/// Computes ∇E, n×3 [N].
MatrixXd elastic_gradient(const Cloth& cloth, const MatrixXd& x) {
  MatrixXd gradient = MatrixXd::Zero(x.rows(), 3);
  for (const Spring& spring : cloth.springs) {
    const Vector3d d = x.row(spring.i) - x.row(spring.j);
    const double length = d.norm();
    const Vector3d g = spring.stiffness * (length - spring.rest_length) / length * d;
    for (int axis = 0; axis < 3; ++axis) {
      gradient(spring.i, axis) += g[axis];
      gradient(spring.j, axis) -= g[axis];
    }
  }
  return gradient;
}

/// Computes ∇g = M(x−y)/h² + ∇E(x), n×3 [N].
MatrixXd objective_gradient(const Cloth& cloth, double h, const MatrixXd& x, const MatrixXd& y) {
  return cloth.masses.asDiagonal() * (x - y) / (h * h) + elastic_gradient(cloth, x);
}

class SemiImplicit final : public Stepper {
 public:
  SemiImplicit(const Cloth& cloth, const Settings& settings) : Stepper(cloth, settings) {}

  void step() override {
    const double h = settings_.step;
    MatrixXd acceleration = external_acceleration();
    acceleration -= cloth_.masses.cwiseInverse().asDiagonal() * elastic_gradient(cloth_, positions);
    for (const int pin : cloth_.pins) acceleration.row(pin).setZero();
    velocities += h * acceleration;
    velocities *= std::pow(settings_.damping, h);
    positions += h * velocities;
  }
};

class Newton final : public Stepper {
 public:
  Newton(const Cloth& cloth, const Settings& settings)
      : Stepper(cloth, settings), selection_(selection_matrix(pinned_)) {}

  void step() override {
    find_inertial_positions();
    MatrixXd x = inertial_positions;
    for (iterations = 1; iterations <= settings_.max_iterations.value_or(20); ++iterations) {
      const MatrixXd gradient = objective_gradient(cloth_, settings_.step, x, inertial_positions);
      Eigen::SimplicialLDLT<SparseMatrix> solver;
      solver.compute(selection_ * objective_hessian(x) * selection_.transpose());
      const VectorXd change = solver.solve(-(selection_ * flatten(gradient)));
      x += unflatten(selection_.transpose() * change);
      if (iterations >= 2 && change.norm() < settings_.tolerance) break;
    }
    iterations = std::min(iterations, settings_.max_iterations.value_or(20));
    finish_implicit_step(x);
  }

 private:
  [[nodiscard]] Matrix3d spring_hessian(const Spring& spring, const Vector3d& d) const {
    const double k = spring.stiffness, length = d.norm(), rest = spring.rest_length;
    const Matrix3d along = d * d.transpose() / (length * length);
    if (length < rest) {
      return settings_.compressed == CompressedHessian::projected ? Matrix3d(k * along)
                                                                  : Matrix3d(k * (rest / length) * along);
    }
    return k * along + k * (1 - rest / length) * (Matrix3d::Identity() - along);
  }

  /// Assembles M/h² + Σ of the springs' Hessians, 3n×3n [N/m].
  [[nodiscard]] SparseMatrix objective_hessian(const MatrixXd& x) const {
    Triplets triplets;
    triplets.reserve(3 * static_cast<std::size_t>(cloth_.masses.size()) + 36 * cloth_.springs.size());
    for (int i = 0; i < cloth_.vertex_count(); ++i) {
      const double diagonal = cloth_.masses[i] / (settings_.step * settings_.step);
      for (int axis = 0; axis < 3; ++axis) triplets.emplace_back(3 * i + axis, 3 * i + axis, diagonal);
    }
    for (const Spring& spring : cloth_.springs) {
      const Matrix3d block = spring_hessian(spring, between(x, spring));
      for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) {
          const double value = block(row, column);
          triplets.emplace_back(3 * spring.i + row, 3 * spring.i + column, value);
          triplets.emplace_back(3 * spring.j + row, 3 * spring.j + column, value);
          triplets.emplace_back(3 * spring.i + row, 3 * spring.j + column, -value);
          triplets.emplace_back(3 * spring.j + row, 3 * spring.i + column, -value);
        }
      }
    }
    const Index rows = Index{3} * cloth_.vertex_count();
    SparseMatrix hessian(rows, rows);
    hessian.setFromTriplets(triplets.begin(), triplets.end());
    return hessian;
  }

  SparseMatrix selection_;  ///< S
};

class Liu13 final : public Stepper {
 public:
  Liu13(const Cloth& cloth, const Settings& settings)
      : Stepper(cloth, settings), selection_(selection_matrix(pinned_)) {
    const int unknowns = 3 * cloth.vertex_count();
    const double h = settings.step;
    Triplets mass, stiffness, pull;
    for (int i = 0; i < unknowns; ++i) mass.emplace_back(i, i, cloth.masses[i / 3]);
    for (int s = 0; s < static_cast<int>(cloth.springs.size()); ++s) {
      const Spring& spring = cloth.springs[static_cast<std::size_t>(s)];
      const double k = spring.stiffness;
      for (int axis = 0; axis < 3; ++axis) {
        const int i = 3 * spring.i + axis, j = 3 * spring.j + axis;
        stiffness.insert(stiffness.end(), {{i, i, k}, {j, j, k}, {i, j, -k}, {j, i, -k}});
        pull.insert(pull.end(), {{i, 3 * s + axis, k}, {j, 3 * s + axis, -k}});
      }
    }
    mass_.resize(unknowns, unknowns);
    mass_.setFromTriplets(mass.begin(), mass.end());
    SparseMatrix laplacian(unknowns, unknowns);
    laplacian.setFromTriplets(stiffness.begin(), stiffness.end());
    pull_.resize(unknowns, 3 * static_cast<Index>(cloth.springs.size()));
    pull_.setFromTriplets(pull.begin(), pull.end());

    matrix_ = mass_ + h * h * laplacian;
    solver_.compute(selection_ * matrix_ * selection_.transpose());
  }

  void step() override {
    const double h = settings_.step;
    find_inertial_positions();
    const VectorXd y = flatten(inertial_positions);
    VectorXd free = selection_ * y;
    const VectorXd fixed = y - selection_.transpose() * free;
    const VectorXd constant = mass_ * y - matrix_ * fixed;

    VectorXd x = y;
    for (iterations = 1; iterations <= settings_.max_iterations.value_or(100); ++iterations) {
      const VectorXd right = h * h * (pull_ * rest_vectors(x)) + constant;
      const VectorXd new_free = solver_.solve(selection_ * right);
      const double change = (new_free - free).norm();
      free = new_free;
      x = selection_.transpose() * free + fixed;
      if (iterations >= 2 && change < settings_.tolerance) break;
    }
    iterations = std::min(iterations, settings_.max_iterations.value_or(100));
    finish_implicit_step(unflatten(x));
  }

 private:
  /// Returns d, 3m [m]: each spring at its rest length in its current direction.
  [[nodiscard]] VectorXd rest_vectors(const VectorXd& x) const {
    VectorXd d(3 * static_cast<Index>(cloth_.springs.size()));
    Index row = 0;
    for (const Spring& spring : cloth_.springs) {
      const Vector3d direction = (x.segment<3>(Index{3} * spring.i) - x.segment<3>(Index{3} * spring.j)).normalized();
      d.segment<3>(row) = spring.rest_length * direction;
      row += 3;
    }
    return d;
  }

  SparseMatrix selection_;  ///< S
  SparseMatrix mass_;       ///< M, 3n×3n [kg]
  SparseMatrix matrix_;     ///< M + h²L, 3n×3n [kg]
  SparseMatrix pull_;       ///< J, 3n×3m [N/m]
  Eigen::SimplicialLLT<SparseMatrix> solver_;
};

}  // namespace

Stepper::Stepper(const Cloth& cloth, const Settings& settings)
    : positions(cloth.positions),
      velocities(cloth.velocities),
      cloth_(cloth),
      settings_(settings),
      pinned_(static_cast<std::size_t>(cloth.vertex_count()), false) {
  for (const int pin : cloth.pins) pinned_[static_cast<std::size_t>(pin)] = true;
}

MatrixXd Stepper::external_acceleration() const {
  MatrixXd acceleration = settings_.gravity.transpose().replicate(positions.rows(), 1);
  if (!settings_.sphere) return acceleration;
  const Sphere& sphere = *settings_.sphere;
  for (Index i = 0; i < positions.rows(); ++i) {
    const Vector3d d = positions.row(i).transpose() - sphere.center;
    const double depth = std::max(sphere.scale * sphere.radius - d.norm(), 0.0);
    acceleration.row(i) += sphere.stiffness * depth * d.normalized();
  }
  return acceleration;
}

void Stepper::find_inertial_positions() {
  const double h = settings_.step;
  inertial_positions = positions + h * velocities + h * h * external_acceleration();
  for (const int pin : cloth_.pins) inertial_positions.row(pin) = positions.row(pin);
}

void Stepper::finish_implicit_step(const MatrixXd& new_positions) {
  velocities = (new_positions - positions) / settings_.step;
  velocities *= std::pow(settings_.damping, settings_.step);
  positions = new_positions;
}

std::unique_ptr<Stepper> make_semi_implicit(const Cloth& cloth, const Settings& settings) {
  return std::make_unique<SemiImplicit>(cloth, settings);
}

std::unique_ptr<Stepper> make_newton(const Cloth& cloth, const Settings& settings) {
  return std::make_unique<Newton>(cloth, settings);
}

std::unique_ptr<Stepper> make_liu13(const Cloth& cloth, const Settings& settings) {
  return std::make_unique<Liu13>(cloth, settings);
}

double gradient_norm(const Cloth& cloth, const Settings& settings, const Stepper& stepper) {
  MatrixXd gradient = objective_gradient(cloth, settings.step, stepper.positions, stepper.inertial_positions);
  for (const int pin : cloth.pins) gradient.row(pin).setZero();
  return gradient.norm();
}

Energies energies(const Cloth& cloth, const Settings& settings, const Stepper& stepper) {
  Energies result;
  for (Index i = 0; i < cloth.masses.size(); ++i) {
    result.kinetic += 0.5 * cloth.masses[i] * stepper.velocities.row(i).squaredNorm();
    result.gravity -= cloth.masses[i] * settings.gravity.dot(stepper.positions.row(i));
  }
  for (const Spring& spring : cloth.springs) {
    const double stretch = between(stepper.positions, spring).norm() - spring.rest_length;
    result.elastic += 0.5 * spring.stiffness * stretch * stretch;
  }
  return result;
}

namespace {

/// Arrays of a colour's pass.
struct Pass {
  const int *first, *second;
  const double *rest, *compliance, *inverse_masses;
  double *x, *y, *z;
};

/// Moves the ends of all springs of a colour. No vertex occurs twice, so the loop has no dependencies.
#if defined(__x86_64__)
__attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#endif
void project(const Pass& p, int count) {
  double *const x = p.x, *const y = p.y, *const z = p.z;
#pragma GCC ivdep
  for (int s = 0; s < count; ++s) {
    const int i = p.first[s], j = p.second[s];
    const double dx = x[j] - x[i], dy = y[j] - y[i], dz = z[j] - z[i];
    const double length = std::sqrt(dx * dx + dy * dy + dz * dz);
    const double push = (length - p.rest[s]) / (p.compliance[s] * length);
    const double mine = p.inverse_masses[i] * push, other = p.inverse_masses[j] * push;
    x[i] += mine * dx;
    y[i] += mine * dy;
    z[i] += mine * dz;
    x[j] -= other * dx;
    y[j] -= other * dy;
    z[j] -= other * dz;
  }
}

}  // namespace

Xpbd::Xpbd(const Cloth& cloth, const Settings& settings) : Stepper(cloth, settings) {
  const auto count = static_cast<std::size_t>(cloth.vertex_count());
  inverse_masses_ = cloth.masses.array().inverse();
  for (const int pin : cloth.pins) inverse_masses_[pin] = 0;
  std::vector<std::vector<char>> used;  // by colour and vertex
  for (const Spring& spring : cloth.springs) {
    const auto i = static_cast<std::size_t>(spring.i), j = static_cast<std::size_t>(spring.j);
    std::size_t color = 0;
    while (color < used.size() && (used[color][i] != 0 || used[color][j] != 0)) ++color;
    if (color == used.size()) {
      used.emplace_back(count, 0);
      colors_.emplace_back();
    }
    used[color][i] = used[color][j] = 1;
    colors_[color].first.push_back(spring.i);
    colors_[color].second.push_back(spring.j);
    colors_[color].rest.push_back(spring.rest_length);
    colors_[color].compliance.push_back(inverse_masses_[spring.i] + inverse_masses_[spring.j] +
                                        1 / (spring.stiffness * settings.step * settings.step));
  }
}

void Xpbd::step() {
  const double h = settings_.step;
  const Eigen::MatrixXd before = positions;
  const Eigen::ArrayXd free = (inverse_masses_ > 0).cast<double>();
  positions.array() += h * ((velocities.rowwise() + h * settings_.gravity.transpose()).array().colwise() * free);
  for (const Color& color : colors_) {
    project({color.first.data(), color.second.data(), color.rest.data(), color.compliance.data(),
             inverse_masses_.data(), positions.col(0).data(), positions.col(1).data(), positions.col(2).data()},
            static_cast<int>(color.first.size()));
  }
  velocities = std::pow(settings_.damping, h) / h * (positions - before);
}

}  // namespace drape::textbook
