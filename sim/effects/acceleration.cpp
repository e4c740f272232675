#include "drape/sim/effects/acceleration.hpp"

#include <fmt/format.h>
#include <limits>
#include <utility>

#include "core/keys.hpp"
#include "drape/sim/settings.hpp"
#include "sim/formula.hpp"
#include "sim/system.hpp"

namespace drape {
namespace {

/// Uniform acceleration, constant in time.
struct UniformAcceleration final : Force {
  Eigen::Vector3d acceleration;   ///< [m/s²]
  const Eigen::VectorXd& masses;  ///< masses of the system's cloth [kg]

  UniformAcceleration(const Eigen::Vector3d& a, const Eigen::VectorXd& m) : acceleration(a), masses(m) {}
  [[nodiscard]] bool constant() const override { return true; }
  void add(const State&, double, Vertices& force) const override {
    for (int axis = 0; axis < 3; ++axis) force.col(axis) += acceleration[axis] * masses;
  }
};

class FieldForce final : public Force {
 public:
  FieldForce(const Field& field, const Eigen::VectorXd& masses)
      : formulas_(field.acceleration),
        masses_(masses),
        constant_(!formulas_.uses_position() && !formulas_.uses_time() && !formulas_.uses_velocity()),
        by_velocity_(formulas_.uses_velocity()),
        bound_(
            field.stiffness_bound.value_or(formulas_.uses_position() ? std::numeric_limits<double>::infinity() : 0)) {}

  [[nodiscard]] bool constant() const override { return constant_; }
  [[nodiscard]] bool depends_on_velocity() const override { return by_velocity_; }
  [[nodiscard]] double stiffness_bound() const override { return bound_; }

  void add(const State& state, double time, Vertices& force) const override {
    for (Eigen::Index i = 0; i < masses_.size(); ++i) {
      const auto x = state.x.row(i), v = state.v.row(i);
      const auto [ax, ay, az] = formulas_.at({x[0], x[1], x[2], time, v[0], v[1], v[2]});
      force.row(i) += masses_[i] * Eigen::RowVector3d(ax, ay, az);
    }
  }

 private:
  FormulaField formulas_;
  Eigen::VectorXd masses_;
  bool constant_, by_velocity_;
  double bound_;  // infinite if unknown
};

}  // namespace

void Gravity::describe(Keys& keys) { keys.add("acceleration", &acceleration, "m/s²", "Acceleration of every vertex."); }

void Gravity::install(System& system) const {
  system.gravity += acceleration;
  system.forces.push_back(std::make_unique<UniformAcceleration>(acceleration, system.cloth.masses));
}

void Wind::describe(Keys& keys) {
  keys.add("acceleration", &acceleration, "m/s²", "Acceleration of every vertex.").must_be_given();
}

void Wind::install(System& system) const {
  system.forces.push_back(std::make_unique<UniformAcceleration>(acceleration, system.cloth.masses));
}

void Field::describe(Keys& keys) {
  keys.add("acceleration", FormulaList{&acceleration, FormulaField::problem}, "m/s²",
           "Acceleration of every vertex, as formulas in its position x, y, z (m), the time t (s) and its velocity vx, "
           "vy, vz (m/s).")
      .must_be_given();
  keys.add("stiffness_bound", &stiffness_bound, "1/s²",
           "Largest change of the acceleration per metre. Explicit methods need it to find their largest stable step.")
      .at_least(0);
}

void Field::check(const SimulationSettings& settings, const ProblemSink& problem) const {
  const Method method = settings.integrator.method;
  if (stiffness_bound || !is_explicit(method) || settings.integrator.allow_unstable) return;
  if (!FormulaField(acceleration).uses_position()) return;
  problem(
      "acceleration",
      fmt::format(
          "it depends on position, so the largest stable step of {} depends on how steep it is, which a formula does "
          "not reveal: give its 'stiffness_bound' [1/s²], or use method = \"implicit\", \"liu13\" or \"quasi-newton\"",
          traits_of(method).title));
}

void Field::install(System& system) const {
  auto force = std::make_unique<FieldForce>(*this, system.cloth.masses);
  auto& list = force->depends_on_velocity() ? system.fields : system.forces;
  list.push_back(std::move(force));
}

}  // namespace drape
