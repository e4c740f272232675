#include "sim/velocity_field.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

namespace drape {

VelocityFields::VelocityFields(const System& system) : cloth_(system.cloth) {
  for (const auto& field : system.fields) fields_.push_back(field.get());
}

void VelocityFields::find(const State& state, double time, Vertices& sum) const {
  sum.setZero(state.x.rows(), 3);
  for (const Force* field : fields_) field->add(state, time, sum);
  sum.array().colwise() /= cloth_.masses.array();
  for (const int pin : cloth_.pins) sum.row(pin).setZero();
}

FieldSlopes::FieldSlopes(const System& system)
    : fields_(system),
      by_position_(static_cast<std::size_t>(system.cloth.vertex_count()), Eigen::Matrix3d::Zero()),
      by_velocity_(by_position_) {}

void FieldSlopes::find(const State& state, double time) {
  moved_.x = state.x;
  moved_.v = state.v;
  differentiate(&State::x, time, by_position_);
  differentiate(&State::v, time, by_velocity_);
}

void FieldSlopes::differentiate(Vertices State::*part, double time, std::vector<Eigen::Matrix3d>& slopes) {
  constexpr double relative = 1e-5;  // about ε^(1/3), where rounding and truncation errors balance
  Vertices& moved = moved_.*part;
  const auto step = [](double from) { return relative * std::max(1.0, std::abs(from)); };
  for (int axis = 0; axis < 3; ++axis) {
    from_ = moved.col(axis);
    way_ = from_.unaryExpr(step);
    moved.col(axis) = from_ - way_;
    fields_.find(moved_, time, before_);
    moved.col(axis) = from_ + way_;
    fields_.find(moved_, time, after_);
    moved.col(axis) = from_;
    for (Eigen::Index i = 0; i < from_.size(); ++i) {
      slopes[static_cast<std::size_t>(i)].col(axis) = (after_.row(i) - before_.row(i)).transpose() / (2 * way_[i]);
    }
  }
}

namespace {

using Eigen::Matrix3d;

/// Returns the product of a block, as in HessianBlocks, and a vector.
auto product(const auto& b, const auto& v) {
  return Eigen::RowVector3d(b[0] * v[0] + b[1] * v[1] + b[2] * v[2], b[1] * v[0] + b[3] * v[1] + b[4] * v[2],
                            b[2] * v[0] + b[4] * v[1] + b[5] * v[2]);
}

}  // namespace

/// Hessian that refers to the energy's blocks of the current step.
class FieldDrag::Hessian final : public EnergyHessian {
 public:
  explicit Hessian(const FieldDrag& drag) : drag_(drag) {}
  void linearise(const Vertices& /*x*/, double /*time*/, double /*concavity*/) override {}
  void add_product(const Vertices& vector, Vertices& sum) const override {
    for (Eigen::Index i = 0; i < vector.rows(); ++i) {
      sum.row(i) += drag_.masses_[i] * product(drag_.q_.row(i), vector.row(i));
    }
  }
  void add_blocks(HessianBlocks& blocks) const override { blocks.vertices += drag_.masses_.asDiagonal() * drag_.q_; }

 private:
  const FieldDrag& drag_;
};

FieldDrag::FieldDrag(const System& system, double duration, bool bounded)
    : masses_(system.cloth.masses),
      duration_(duration),
      bounded_(bounded),
      slopes_(system),
      start_(system.cloth.positions),
      q_(Blocks::Zero(masses_.size(), 6)),
      bound_(Eigen::VectorXd::Zero(masses_.size())) {
  slopes_.find({.x = system.cloth.positions, .v = system.cloth.velocities, .step = 0}, 0);
  for (Eigen::Index i = 0; i < masses_.size(); ++i) {
    const Matrix3d q = drag(static_cast<std::size_t>(i), std::numeric_limits<double>::infinity());
    bound_[i] = masses_[i] * Eigen::SelfAdjointEigenSolver<Matrix3d>(q, Eigen::EigenvaluesOnly).eigenvalues()[2];
  }
}

Matrix3d FieldDrag::drag(std::size_t vertex, double most) const {
  const Matrix3d g = slopes_.by_velocity()[vertex] / duration_ + slopes_.by_position()[vertex];
  if (!g.allFinite()) return Matrix3d::Zero();
  const Matrix3d against = -(g + g.transpose()) / 2;
  const Eigen::SelfAdjointEigenSolver<Matrix3d> parts(against);
  const double square = duration_ * duration_;
  const double turn = square * (g - g.transpose()).norm() / std::sqrt(8.0);  // 2-norm of half the difference
  const double held = turn * turn / (1 + turn) / square;
  const Eigen::Vector3d kept = (parts.eigenvalues().cwiseMax(0).array() + held).cwiseMin(most);
  return parts.eigenvectors() * kept.asDiagonal() * parts.eigenvectors().transpose();
}

bool FieldDrag::begin(const State& state, double time, const Vertices& start) {
  constexpr double same = 1e-6;
  start_ = start;
  before_ = q_;
  slopes_.find(state, time);
  for (Eigen::Index i = 0; i < q_.rows(); ++i) {
    const double most = bounded_ ? bound_[i] / masses_[i] : std::numeric_limits<double>::infinity();
    const Matrix3d q = drag(static_cast<std::size_t>(i), most);
    q_.row(i) << q(0, 0), q(0, 1), q(0, 2), q(1, 1), q(1, 2), q(2, 2);
  }
  return !((q_ - before_).norm() <= same * q_.norm());
}

void FieldDrag::add_pull(const Vertices& x, Vertices& acceleration) const {
  for (Eigen::Index i = 0; i < q_.rows(); ++i) {
    acceleration.row(i) += product(q_.row(i), x.row(i) - start_.row(i));
  }
}

void FieldDrag::add_way(const Vertices& acceleration, Vertices& x) const {
  const double square = duration_ * duration_;
  for (Eigen::Index i = 0; i < q_.rows(); ++i) {
    Matrix3d q;
    q << q_(i, 0), q_(i, 1), q_(i, 2), q_(i, 1), q_(i, 3), q_(i, 4), q_(i, 2), q_(i, 4), q_(i, 5);
    const Matrix3d matrix = Matrix3d::Identity() + square * q;
    const Eigen::Vector3d way = square * acceleration.row(i).transpose();
    x.row(i) += matrix.llt().solve(way).transpose();
  }
}

double FieldDrag::add_gradient(const Vertices& x, double /*time*/, Vertices& gradient) const {
  double twice = 0;
  for (Eigen::Index i = 0; i < q_.rows(); ++i) {
    const Eigen::RowVector3d way = x.row(i) - start_.row(i), pull = masses_[i] * product(q_.row(i), way);
    gradient.row(i) += pull;
    twice += pull.dot(way);
  }
  return twice / 2;
}

std::unique_ptr<EnergyHessian> FieldDrag::make_hessian() const { return std::make_unique<Hessian>(*this); }

}  // namespace drape
