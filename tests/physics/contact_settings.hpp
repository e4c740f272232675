#pragma once

#include <utility>

#include "drape/sim/effects/acceleration.hpp"
#include "tests/support/setups.hpp"

namespace drape::test {

/// Makes a cloth under gravity, solved to convergence, so that solver errors are negligible.
inline SimulationSettings contact_settings(Solver how, Cloth cloth, double step) {
  SimulationSettings result = setup(std::move(cloth), how, step);
  result.integrator.tolerance = 1e-13;
  result.integrator.max_iterations = 2000;
  result.effects = {Gravity{}};
  return result;
}

/// Makes vertices without springs, with masses from 0.5 to 2 kg.
inline Cloth loose(const Vertices& positions) {
  Cloth cloth;
  cloth.positions = positions;
  cloth.velocities = Vertices::Zero(positions.rows(), 3);
  cloth.masses = Eigen::VectorXd::LinSpaced(positions.rows(), 0.5, 2);
  return cloth;
}

}  // namespace drape::test
