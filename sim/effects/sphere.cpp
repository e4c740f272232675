#include "sim/effects/sphere.hpp"

#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace drape {
namespace {

/// How the penalty enters a step.
enum class Response {
  explicit_force,  ///< evaluated at the start of the step, as in the homework
  implicit_energy  ///< part of what an implicit step minimises
};

struct SphereValues {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  double radius = 1;
  double scale = 1.1;
  double stiffness = 8000;
  Response response = Response::explicit_force;

  [[nodiscard]] double reach() const { return scale * radius; }
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
    const double reach = sphere.reach();
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

/// The penalty as an energy: E = Σ m k/2 · max(s·r − ‖x−c‖, 0)². Its Hessian is m k (x̂x̂ᵀ − (s·r/‖x−c‖ − 1)(I − x̂x̂ᵀ)),
/// of which the first term is positive; at the centre itself all are zero.
struct PenaltyEnergy final : Energy {
  SphereValues sphere;
  const Eigen::VectorXd& masses;

  PenaltyEnergy(const SphereValues& s, const Eigen::VectorXd& m) : sphere(s), masses(m) {}

  /// Calls visit(vertex, outward direction, depth) for every vertex within reach.
  template <class Visit>
  void for_touching(const Vertices& x, Visit&& visit) const {
    const double reach = sphere.reach();
    for (Eigen::Index i = 0; i < x.rows(); ++i) {
      const Eigen::Vector3d d = x.row(i).transpose() - sphere.center;
      const double squared = d.squaredNorm();
      if (squared >= reach * reach || squared == 0) continue;
      const double distance = std::sqrt(squared);
      visit(i, Eigen::Vector3d(d / distance), reach - distance);
    }
  }

  double add_gradient(const Vertices& x, double, Vertices& gradient) const override {
    double total = 0;
    for_touching(x, [&](Eigen::Index i, const Eigen::Vector3d& outward, double depth) {
      const double pressure = masses[i] * sphere.stiffness * depth;
      gradient.row(i) -= pressure * outward.transpose();
      total += 0.5 * pressure * depth;
    });
    return total;
  }

  void add_hessian(const Vertices& x, double, DiagonalBlocks& blocks) const override {
    for_touching(x, [&](Eigen::Index i, const Eigen::Vector3d& n, double) {
      Eigen::Matrix<double, 1, 6> products;
      products << n[0] * n[0], n[0] * n[1], n[0] * n[2], n[1] * n[1], n[1] * n[2], n[2] * n[2];
      blocks.row(i) += masses[i] * sphere.stiffness * products;
    });
  }

  void add_bound(Eigen::VectorXd& bound) const override { bound += sphere.stiffness * masses; }
};

class Sphere final : public Effect {
 public:
  void describe(Keys& keys) override {
    keys.add("center", &values_.center, "m", "Where its centre is.").must_be_given();
    keys.add("radius", &values_.radius, "m", "Its radius, as it is drawn.").must_be_given().above(0);
    keys.add("scale", &values_.scale, "", "Where it pushes: within scale·radius of the centre.").at_least(1);
    keys.add("stiffness", &values_.stiffness, "1/s²", "Acceleration per metre that a vertex is within that reach.")
        .at_least(0);
    keys.choice("response", values_.response, {"explicit", "implicit"},
                "Whether the push is evaluated at the start of a step, or solved for together with the springs.");
  }

  void check(const SimulationSettings& settings, const ProblemSink& problem) const override {
    if (values_.response == Response::implicit_energy) {
      if (settings.integrator.method == Method::semi_implicit) {
        problem(
            "response",
            "semi-implicit Euler evaluates every force at the start of a step and solves for nothing, so the push can "
            "only be \"explicit\" with it; the other methods take \"implicit\" too");
      }
      return;
    }
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
    if (values_.response == Response::implicit_energy) {
      system.energies.push_back(std::make_unique<PenaltyEnergy>(values_, system.cloth.masses));
    } else {
      system.forces.push_back(std::make_unique<Penalty>(values_, system.cloth.masses));
    }
  }

 private:
  SphereValues values_;
};

}  // namespace

std::unique_ptr<Effect> make_sphere() { return std::make_unique<Sphere>(); }

}  // namespace drape
