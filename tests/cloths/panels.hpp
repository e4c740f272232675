#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "drape/sim/effects/acceleration.hpp"
#include "drape/sim/mesh.hpp"
#include "drape/sim/simulation.hpp"
#include "sim/schemes/stability_guard.hpp"
#include "sim/stability.hpp"
#include "sim/system.hpp"
#include "tests/support/setups.hpp"

namespace drape::test {

/// Makes a level rectangle with its lower left corner at a point, of 0.2 kg/m² and 100 N/m.
inline Cloth panel(int columns, int rows, const Eigen::Vector2d& size, const Eigen::RowVector3d& corner) {
  const Mesh mesh = make_grid({.columns = columns, .rows = rows, .size = size});
  Mesh placed = mesh;
  placed.positions.rowwise() += corner + Eigen::RowVector3d(size.x() / 2, size.y() / 2, 0);
  Cloth cloth = make_cloth(placed, placed, 1, 100, {});
  share_mass_by_area(0.2, cloth);
  stiffen_by_area(100, cloth);
  return cloth;
}

/// Joins cloths, named a, b, c, …
inline Cloth joined(const std::vector<Cloth>& cloths) {
  Cloth all;
  for (std::size_t k = 0; k < cloths.size(); ++k) append(std::string(1, static_cast<char>('a' + k)), cloths[k], all);
  return all;
}

/// Makes settings for a method whose solves are so exact that only the law remains. An explicit method takes the fewest
/// stable substeps.
inline SimulationSettings exactly(Cloth cloth, const NamedMethod& method, double step, Effects effects = {}) {
  SimulationSettings settings = setup(std::move(cloth), method, step);
  settings.effects = std::move(effects);
  if (method.is_explicit()) {
    settings.integrator.substeps.reset();
    const double longest = safe_step(make_system(settings));
    settings.integrator.substeps = static_cast<int>(SubstepGuard::fewest_substeps(step, longest));
  } else {
    settings.integrator.stop = StoppingRule::error;
    settings.integrator.tolerance = 1e-9;
    settings.integrator.max_iterations = 2000;
  }
  return settings;
}

inline Eigen::RowVector3d momentum_of(const Cloth& cloth, const Vertices& v) { return cloth.masses.transpose() * v; }

inline Eigen::RowVector3d angular_momentum_of(const Cloth& cloth, const Vertices& x, const Vertices& v) {
  Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
  for (Eigen::Index i = 0; i < x.rows(); ++i) sum += cloth.masses[i] * x.row(i).cross(v.row(i));
  return sum;
}

/// Returns the vector of a seam's tie.
inline Eigen::RowVector3d way_of(const SeamTie& tie, const Vertices& x) {
  return x.row(tie.vertex) - (1 - tie.share) * x.row(tie.edge[0]) - tie.share * x.row(tie.edge[1]);
}

/// Returns the longest tie of all seams [m].
inline double gap_of(const Cloth& cloth, const Vertices& x) {
  double most = 0;
  for (const Seam& seam : cloth.seams) {
    for (const SeamTie& tie : seam.ties) most = std::max(most, way_of(tie, x).norm());
  }
  return most;
}

/// Methods for contact and seams: those that solve, those with impulses, and the scheme that leaves both to backward
/// Euler.
inline constexpr std::array sewing_methods{
    NamedMethod{Method::implicit, "Implicit"},
    NamedMethod{Method::liu13, "Liu13"},
    NamedMethod{Method::quasi_newton, "QuasiNewton"},
    NamedMethod{Method::verlet, "Verlet"},
    NamedMethod{Method::semi_implicit, "SemiImplicit"},
    NamedMethod{{Method::quasi_newton, TimeScheme::sdirk2}, "QuasiNewtonSdirk2"},
};

}  // namespace drape::test
