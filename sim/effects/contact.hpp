#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "sim/effects/effect.hpp"

namespace drape {

/// How a penalty enters a step.
enum class Response {
  explicit_force,  ///< evaluated at the start of the step, as in the homework
  implicit_energy  ///< part of what an implicit step minimises
};

/// How a surface answers a vertex within its reach: it pushes outwards with an acceleration of stiffness·depth.
struct ContactValues {
  double stiffness = 8000;  ///< [1/s²]
  Response response = Response::explicit_force;
  double friction = 0;     ///< Coulomb's coefficient
  double restitution = 1;  ///< 1: the push gives back all the speed it took

  /// Adds the keys for all of it.
  void describe(Keys& keys);
  /// Says what is wrong with them in these settings.
  void check(const SimulationSettings& settings, const Effect::ProblemSink& problem) const;
};

/// A vertex within a surface's reach.
struct Touch {
  Eigen::Vector3d away;  ///< points outwards [m]
  double distance = 1;   ///< the length of it, above 0 [m]
  double depth = 0;      ///< below the reach [m]

  [[nodiscard]] Eigen::Vector3d normal() const { return away / distance; }
};

// A moving surface M is a function of time: M.at(time) is an object whose find(point, touch) says whether the point is
// within reach, and fills in how; M.displacement(from, to) is how far it moves in between [m]. Contact takes it as a
// template parameter, so that the loops over the vertices hold the geometry and no virtual call.

/// The push as a force, a = stiffness·depth outwards; where no direction leads outwards there is none.
template <class Surface>
struct PenaltyForce final : Force {
  Surface surface;
  double stiffness;
  const Eigen::VectorXd& masses;

  PenaltyForce(Surface s, double k, const Eigen::VectorXd& m) : surface(std::move(s)), stiffness(k), masses(m) {}

  [[nodiscard]] double stiffness_bound() const override { return stiffness; }

  void add(const State& state, double time, Vertices& force) const override {
    const auto now = surface.at(time);
    Touch touch;
    for (Eigen::Index i = 0; i < state.x.rows(); ++i) {
      if (!now.find(state.x.row(i).transpose(), touch)) continue;
      const double pressure = masses[i] * stiffness * touch.depth / touch.distance;
      force.row(i) += pressure * touch.away.transpose();
    }
  }
};

/// The push as an energy, E = Σ m·stiffness/2·depth². Its Hessian is m·stiffness·(nnᵀ − depth·∇n), of which the first
/// term is positive and the second, where the surface is convex, negative.
template <class Surface>
struct PenaltyEnergy final : Energy {
  Surface surface;
  double stiffness;
  const Eigen::VectorXd& masses;

  PenaltyEnergy(Surface s, double k, const Eigen::VectorXd& m) : surface(std::move(s)), stiffness(k), masses(m) {}

  double add_gradient(const Vertices& x, double time, Vertices& gradient) const override {
    const auto now = surface.at(time);
    double total = 0;
    Touch touch;
    for (Eigen::Index i = 0; i < x.rows(); ++i) {
      if (!now.find(x.row(i).transpose(), touch)) continue;
      const double pressure = masses[i] * stiffness * touch.depth;
      gradient.row(i) -= pressure * touch.normal().transpose();
      total += 0.5 * pressure * touch.depth;
    }
    return total;
  }

  void add_hessian(const Vertices& x, double time, DiagonalBlocks& blocks) const override {
    const auto now = surface.at(time);
    Touch touch;
    for (Eigen::Index i = 0; i < x.rows(); ++i) {
      if (!now.find(x.row(i).transpose(), touch)) continue;
      const Eigen::Vector3d n = touch.normal();
      Eigen::Matrix<double, 1, 6> products;
      products << n[0] * n[0], n[0] * n[1], n[0] * n[2], n[1] * n[1], n[1] * n[2], n[2] * n[2];
      blocks.row(i) += masses[i] * stiffness * products;
    }
  }

  void add_bound(Eigen::VectorXd& bound) const override { bound += stiffness * masses; }
};

/// Friction, and what the push may give back, as a change of a step's velocities relative to the surface (Bridson,
/// Fedkiw and Anderson 2002, section 5, with the penalty's own impulse as the normal one). In a step the push adds
/// h·stiffness·depth to a vertex's outward speed; friction takes at most `friction` times that from the speed along the
/// surface, and stops it if that is enough. So what rests on a slope of tan θ ≤ µ stays, to the bit.
///
/// Restitution limits the outward speed to what carries a vertex out of the surface as a critically damped spring
/// would, √stiffness·depth and no further than the reach; of what exceeds that, it is the share that stays.
template <class Surface>
struct ContactFilter final : MotionFilter {
  Surface surface;
  ContactValues values;
  std::vector<int> free;  // the vertices that are not pinned

  ContactFilter(Surface s, const ContactValues& v, const Cloth& cloth) : surface(std::move(s)), values(v) {
    std::vector<bool> pinned(static_cast<std::size_t>(cloth.vertex_count()), false);
    for (const int pin : cloth.pins) pinned[static_cast<std::size_t>(pin)] = true;
    for (int i = 0; i < cloth.vertex_count(); ++i) {
      if (!pinned[static_cast<std::size_t>(i)]) free.push_back(i);
    }
  }

  void apply(const Vertices& x, double time, double h, Vertices& v) override {
    // The push was evaluated where the vertices are, or solved for where they go.
    const bool at_end = values.response == Response::implicit_energy;
    const auto now = surface.at(at_end ? time + h : time);
    const Eigen::Vector3d drift = surface.displacement(time, time + h) / h;
    const double softest = std::min(std::sqrt(values.stiffness), 1 / h);
    Touch touch;
    for (const int i : free) {
      Eigen::Vector3d point = x.row(i).transpose();
      if (at_end) point += h * v.row(i).transpose();
      if (!now.find(point, touch)) continue;
      const Eigen::Vector3d n = touch.normal();
      const Eigen::Vector3d relative = v.row(i).transpose() - drift;
      double outward = relative.dot(n);
      const Eigen::Vector3d along = relative - outward * n;
      double push = h * values.stiffness * touch.depth;
      const double taken = (1 - values.restitution) * std::max(0.0, outward - softest * touch.depth);
      outward -= taken;
      push = std::max(0.0, push - taken);
      const double speed = along.norm(), lost = values.friction * push;
      const double kept = speed > lost ? 1 - lost / speed : 0;
      v.row(i) = (drift + outward * n + kept * along).transpose();
    }
  }
};

/// Adds what the values ask for to the system.
template <class Surface>
void install_contact(const Surface& surface, const ContactValues& values, System& system) {
  const Eigen::VectorXd& masses = system.cloth.masses;
  if (values.response == Response::implicit_energy) {
    system.energies.push_back(std::make_unique<PenaltyEnergy<Surface>>(surface, values.stiffness, masses));
  } else {
    system.forces.push_back(std::make_unique<PenaltyForce<Surface>>(surface, values.stiffness, masses));
  }
  if (values.friction > 0 || values.restitution < 1) {
    system.filters.push_back(std::make_unique<ContactFilter<Surface>>(surface, values, system.cloth));
  }
}

}  // namespace drape
