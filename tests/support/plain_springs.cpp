#include "tests/support/plain_springs.hpp"

#include <cmath>

namespace drape::test {

double plain_energy(const std::vector<Spring>& springs, const Vertices& x) {
  double energy = 0;
  for (const Spring& s : springs) {
    const double stretch = (x.row(s.i) - x.row(s.j)).norm() - s.rest_length;
    energy += s.stiffness / 2 * stretch * stretch;
  }
  return energy;
}

Vertices plain_gradient(const std::vector<Spring>& springs, const Vertices& x) {
  Vertices gradient = Vertices::Zero(x.rows(), 3);
  for (const Spring& s : springs) {
    const Eigen::RowVector3d d = x.row(s.i) - x.row(s.j);
    const double length = d.norm();
    if (length == 0) continue;
    const Eigen::RowVector3d force = s.stiffness * (length - s.rest_length) * d / length;
    gradient.row(s.i) += force;
    gradient.row(s.j) -= force;
  }
  return gradient;
}

Vertices plain_dashpots(const std::vector<Spring>& springs, const Vertices& x, const Vertices& v) {
  Vertices sum = Vertices::Zero(x.rows(), 3);
  for (const Spring& s : springs) {
    const Eigen::RowVector3d along = (x.row(s.i) - x.row(s.j)).normalized();
    const Eigen::RowVector3d force = s.stiffness * along.dot(v.row(s.i) - v.row(s.j)) * along;
    sum.row(s.i) += force;
    sum.row(s.j) -= force;
  }
  return sum;
}

State exact_motion(const Cloth& cloth, const Eigen::Vector3d& acceleration, double damping, double duration, int steps,
                   double relaxation) {
  const auto accelerations = [&](const Vertices& x, const Vertices& v) {
    Vertices force = plain_gradient(cloth.springs, x);
    if (relaxation > 0) force += relaxation * plain_dashpots(cloth.springs, x, v);
    Vertices a = -(cloth.masses.cwiseInverse().asDiagonal() * force);
    a += std::log(damping) * v;
    a.rowwise() += acceleration.transpose();
    for (const int pin : cloth.pins) a.row(pin).setZero();
    return a;
  };
  const double h = duration / steps;
  State state{.x = cloth.positions, .v = cloth.velocities, .step = steps};
  for (const int pin : cloth.pins) state.v.row(pin).setZero();
  for (int step = 0; step < steps; ++step) {
    const Vertices& x = state.x;
    const Vertices v1 = state.v, a1 = accelerations(x, v1);
    const Vertices v2 = v1 + h / 2 * a1, a2 = accelerations(x + h / 2 * v1, v2);
    const Vertices v3 = v1 + h / 2 * a2, a3 = accelerations(x + h / 2 * v2, v3);
    const Vertices v4 = v1 + h * a3, a4 = accelerations(x + h * v3, v4);
    state.x += h / 6 * (v1 + 2 * v2 + 2 * v3 + v4);
    state.v += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
  }
  return state;
}

}  // namespace drape::test
