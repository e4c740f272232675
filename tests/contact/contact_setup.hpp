#pragma once

#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "drape/sim/cloth.hpp"
#include "drape/sim/effects/acceleration.hpp"
#include "drape/sim/effects/bending.hpp"
#include "drape/sim/effects/body.hpp"
#include "drape/sim/effects/ground.hpp"
#include "drape/sim/effects/self_collision.hpp"
#include "drape/sim/effects/sphere.hpp"
#include "drape/sim/simulation.hpp"
#include "sim/schemes/stability_guard.hpp"
#include "sim/stability.hpp"
#include "sim/system.hpp"
#include "tests/support/setups.hpp"

namespace drape::test {

inline constexpr double g = 9.8;          // default gravity [m/s²]
inline constexpr double distance = 0.01;  // contact distance [m]

/// The methods that solve for contact within the whole step.
inline constexpr std::array solving_methods{
    NamedMethod{Method::implicit, "Implicit"},
    NamedMethod{Method::liu13, "Liu13"},
    NamedMethod{Method::quasi_newton, "QuasiNewton"},
};

/// The solving methods, the methods with impulses, and the scheme that leaves contact to backward Euler.
inline constexpr std::array contact_methods{
    solving_methods[0],
    solving_methods[1],
    solving_methods[2],
    NamedMethod{Method::verlet, "Verlet"},
    NamedMethod{Method::semi_implicit, "SemiImplicit"},
    NamedMethod{{Method::quasi_newton, TimeScheme::sdirk2}, "QuasiNewtonSdirk2"},
};

/// All ways to compute a step.
inline constexpr std::array all_contact_methods{
    contact_methods[0],
    contact_methods[1],
    contact_methods[2],
    contact_methods[3],
    contact_methods[4],
    contact_methods[5],
    NamedMethod{{Method::implicit, TimeScheme::sdirk2}, "ImplicitSdirk2"},
    NamedMethod{{Method::liu13, TimeScheme::sdirk2}, "Liu13Sdirk2"},
};

/// Divides the steps of an explicit method into the fewest stable substeps, or into as many `ratio` times as short.
inline SimulationSettings divided(SimulationSettings settings, double ratio = 1) {
  if (!is_explicit(settings.integrator.method)) return settings;
  settings.integrator.substeps.reset();
  const double longest = safe_step(make_system(settings)) / ratio;
  settings.integrator.substeps = static_cast<int>(SubstepGuard::fewest_substeps(settings.step, longest));
  return settings;
}

/// Divides the steps of an explicit method so that the energy of vibrations varies little: by (hω)² of velocity Verlet,
/// by hω of semi-implicit Euler.
inline SimulationSettings calm(SimulationSettings settings) {
  return divided(settings, settings.integrator.method == Method::verlet ? calm_ratio : 4);
}

/// Makes each substep of a motion a step.
inline SimulationSettings in_substeps(SimulationSettings settings) {
  settings = divided(settings);
  settings.step /= settings.integrator.substep_count();
  settings.integrator.substeps.reset();
  return settings;
}

/// A test of each contact method.
class Solved : public testing::TestWithParam<NamedMethod> {
 protected:
  /// Makes settings of a cloth under gravity.
  [[nodiscard]] SimulationSettings settings(Cloth cloth, double step) const {
    SimulationSettings result;
    result.cloth = std::move(cloth);
    result.step = step;
    result.integrator.method = GetParam().method;
    result.integrator.scheme = GetParam().scheme;
    result.effects = {Gravity{}};
    return divided(result);
  }
};

/// Makes a level square around the z axis, its own rest shape.
inline Mesh level_square(double side, int cells, double height) {
  Mesh mesh = make_grid(cells, cells);
  mesh.positions *= side / 2;
  mesh.positions.col(2).array() += height;
  return mesh;
}

/// Makes the solves so exact that only the law remains.
inline SimulationSettings exact(SimulationSettings settings) {
  if (is_explicit(settings.integrator.method)) return settings;
  settings.integrator.stop = StoppingRule::error;
  settings.integrator.tolerance = 1e-9;
  return settings;
}

/// Joins several sheets into one cloth.
inline Mesh together(const std::vector<Mesh>& sheets) {
  Mesh all;
  for (const Mesh& sheet : sheets) {
    const auto first = static_cast<int>(all.positions.rows());
    all.positions.conservativeResize(first + sheet.positions.rows(), 3);
    all.positions.bottomRows(sheet.positions.rows()) = sheet.positions;
    for (Triangle t : sheet.triangles) {
      for (int& v : t) v += first;
      all.triangles.push_back(t);
    }
  }
  return all;
}

/// Makes a sheet of 0.2 kg/m² from a mesh.
inline Cloth plain_sheet(const Mesh& start, double stiffness = 180) {
  Cloth cloth = make_cloth(start, start, 1, stiffness, {});
  share_mass_by_area(0.2, cloth);
  return cloth;
}

inline Ground solved_ground(double friction = 0.5, double restitution = 0) {
  return {.thickness = distance, .friction = friction, .restitution = restitution};
}

/// Makes a box with its upper side at height `top`.
inline Body solved_box(const Eigen::Vector3d& size, double top) {
  return {.box = size, .center = Eigen::Vector3d(0, 0, top - size.z() / 2), .thickness = distance};
}

inline SelfCollision solved_self() { return {.thickness = distance}; }

inline Eigen::RowVector3d mean_of(const Cloth& cloth, const Vertices& values) {
  return (cloth.masses.transpose() * values) / cloth.masses.sum();
}

/// Computes the root mean square of the speeds [m/s].
inline double rms_speed(const Simulation& simulation) {
  const Vertices& v = simulation.state().v;
  return v.norm() / std::sqrt(static_cast<double>(v.rows()));
}

inline void run(Simulation& simulation, double until) {
  while (simulation.time() < until - 1e-9) simulation.step();
}

inline std::string lines(const std::vector<std::string>& all) {
  std::string text;
  for (const std::string& line : all) text += line + '\n';
  return text;
}

}  // namespace drape::test
