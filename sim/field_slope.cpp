#include "sim/field_slope.hpp"

#include <algorithm>
#include <cmath>

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
      position_forces_(static_cast<std::size_t>(system.cloth.vertex_count()), Eigen::Matrix3d::Zero()),
      velocity_forces_(position_forces_) {}

void FieldSlopes::find(const State& state, double time) {
  moved_.x = state.x;
  moved_.v = state.v;
  differentiate(&State::x, time, position_forces_);
  differentiate(&State::v, time, velocity_forces_);
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

}  // namespace drape
