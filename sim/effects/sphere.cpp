#include "sim/effects/sphere.hpp"

#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace drape {
namespace {

struct SphereValues {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  double radius = 1;
  double scale = 1.1;
  double stiffness = 8000;
};

struct Pose final : ColliderMotion {
  SphereShape shape;
  explicit Pose(const SphereValues& s) : shape{s.center, s.radius} {}
  [[nodiscard]] Collider at(double) const override { return shape; }
};

/// The homework's penalty: a = k·max(s·r − ‖x−c‖, 0)·(x−c)/‖x−c‖. At the centre itself the direction is undefined and
/// the force is zero.
struct Penalty final : Force {
  SphereValues sphere;
  const Eigen::VectorXd& masses;

  Penalty(const SphereValues& s, const Eigen::VectorXd& m) : sphere(s), masses(m) {}

  void add(const State& state, double, Vertices& force) const override {
    const double reach = sphere.scale * sphere.radius;
    for (Eigen::Index i = 0; i < state.x.rows(); ++i) {
      const double dx = state.x(i, 0) - sphere.center[0];
      const double dy = state.x(i, 1) - sphere.center[1];
      const double dz = state.x(i, 2) - sphere.center[2];
      const double squared = dx * dx + dy * dy + dz * dz;
      if (squared >= reach * reach || squared == 0) continue;
      const double distance = std::sqrt(squared);
      const double pressure = masses[i] * sphere.stiffness * (reach - distance) / distance;
      force(i, 0) += pressure * dx;
      force(i, 1) += pressure * dy;
      force(i, 2) += pressure * dz;
    }
  }
};

class Sphere final : public Effect {
 public:
  void describe(Keys& keys) override {
    keys.add("center", &values_.center, "m", "Where its centre is.").must_be_given();
    keys.add("radius", &values_.radius, "m", "Its radius, as it is drawn.").must_be_given().above(0);
    keys.add("scale", &values_.scale, "", "Where it pushes: within scale·radius of the centre.").at_least(1);
    keys.add("stiffness", &values_.stiffness, "1/s²", "Acceleration per metre that a vertex is within that reach.")
        .at_least(0);
  }

  void check(const SimulationSettings& settings, const ProblemSink& problem) const override {
    // A vertex on the explicit penalty is a harmonic oscillator of frequency √k, which every step that evaluates the
    // force at its start turns unstable beyond h·√k = 2, whatever the method does with the springs.
    const double h = settings.step;
    const double product = h * std::sqrt(values_.stiffness);
    if (product > 2) {
      problem(
          "stiffness",
          fmt::format("an explicit penalty is unstable where step·√stiffness > 2, and here it is {:.3g}: with step = "
                      "{:g} s the stiffness can be at most {:.4g}, or with this stiffness the step at most {:.3g} s",
                      product, h, 4 / (h * h), 2 / std::sqrt(values_.stiffness)));
    }
  }

  void install(System& system) const override {
    system.colliders.push_back(std::make_unique<Pose>(values_));
    system.forces.push_back(std::make_unique<Penalty>(values_, system.cloth.masses));
  }

 private:
  SphereValues values_;
};

}  // namespace

std::unique_ptr<Effect> make_sphere() { return std::make_unique<Sphere>(); }

}  // namespace drape
