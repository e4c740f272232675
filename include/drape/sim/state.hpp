#pragma once

// Example:
//   const drape::State a{.x = drape::Vertices::Zero(4, 3), .v = drape::Vertices::Zero(4, 3)};
//   drape::State b = a;
//   b.x(3, 2) = 1e-300;
//   const bool differ = drape::hash_of(a) != drape::hash_of(b);  // true

// Example:
//   const drape::Collider ball = drape::SphereShape{.center = {0, 0, 1}, .radius = 0.4, .reach = 0.44};
//   if (const auto* sphere = std::get_if<drape::SphereShape>(&ball)) std::printf("%g m", sphere->radius);

// Example:
//   const drape::Energies now{.kinetic = 2, .gravity = -3, .elastic = 0.5};
//   const double all = now.total();  // -0.5 J

// Example:
//   const auto frame_of = [](const drape::Simulation& simulation) {
//     return drape::Frame{.time = simulation.time(),
//                         .positions = simulation.state().x,
//                         .colliders = simulation.colliders(simulation.time())};
//   };

// Example:
//   const drape::Mesh square = drape::make_grid(2, 2);
//   drape::Simulation simulation({.cloth = drape::make_cloth(square, square, 1, 10, {})});
//   const drape::StepReport report = simulation.step();
//   if (!report.converged) std::printf("stopped after %d iterations", report.iterations);

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <variant>
#include <vector>

#include "drape/sim/mesh.hpp"

namespace drape {

/// Effect of strain limits on a cloth in a step; empty without limits.
struct Restraint {
  Vertices acceleration = {};     ///< acceleration removed from the vertices, n×3 [m/s²]
  Eigen::VectorXd tensions = {};  ///< tension added to the cloth's springs; negative if pushing [N]
};

/// Force at a contact of the cloth at the end of a step.
struct ContactForce {
  std::array<std::int32_t, 6> key = {};             ///< identifies the contact: its source, kind and four features
  Eigen::Vector3d force = Eigen::Vector3d::Zero();  ///< [N]
};

/// Position and motion of a cloth after `step` steps. Time is step·h, never accumulated.
struct State {
  Vertices x = {};  ///< n×3 [m]
  Vertices v = {};  ///< n×3 [m/s]
  std::int64_t step = 0;
  /// Effect of strain limits in the last step, an initial guess for the implicit solve and the limits of the next. It
  /// influences the motion only within their tolerances.
  Restraint restraint = {};
  /// Number of substeps to begin the next step with, if an accuracy is set; 0: none known.
  std::int64_t substeps = 0;
  /// Friction contacts of implicit methods at the end of the last step, an initial guess for the next like `restraint`.
  std::vector<ContactForce> contact_forces = {};
};

/// Returns a hash of all bits of a state. Two runs with the same hash agree from there on. Not cryptographic.
std::uint64_t hash_of(const State& state);

/// Energy history of a simulation, to detect a blow-up or a step that gains energy.
struct EnergyMemory {
  double explained = 0;          ///< initial energy plus the work of the forces so far [J]
  Vertices checked_at;           ///< positions at the last check, n×3 [m]
  double work = 0;               ///< since the last check; by SDIRK2: since the start, plus the initial energy [J]
  std::optional<double> energy;  ///< kinetic and elastic energy at the last check, for SDIRK2 [J]
};

/// A sphere at one moment.
struct SphereShape {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();  ///< [m]
  double radius = 1;                                 ///< drawn radius [m]
  double reach = 0;                                  ///< distance from the centre within which it pushes [m]
};

/// A half-space: all points with normal·x ≤ height.
struct GroundShape {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< outward unit normal
  double height = 0;                                  ///< height of the surface above the origin, along the normal [m]
  double thickness = 0;                               ///< thickness of the pushing layer above the surface [m]
};

/// A triangle mesh at one moment.
struct MeshShape {
  std::shared_ptr<const std::vector<Triangle>> triangles;  ///< the same object at every moment
  Vertices positions;                                      ///< n×3 [m]
  double thickness = 0;                                    ///< thickness of the pushing layer around the mesh [m]
};

/// Shape of an obstacle at one moment, as drawn.
using Collider = std::variant<SphereShape, GroundShape, MeshShape>;

/// The energies of a cloth at one moment [J].
struct Energies {
  double kinetic = 0;  ///< Σ m v²/2
  double gravity = 0;  ///< −Σ m g·x
  double elastic = 0;  ///< energy of all springs and of bending

  [[nodiscard]] double total() const { return kinetic + gravity + elastic; }
};

/// One moment of a motion: all positions, as needed for drawing, and optional velocities and energies of the cloth.
struct Frame {
  int index = 0;                          ///< number of the frame, from 0
  double time = 0;                        ///< in the scene's time [s]
  Vertices positions = {};                ///< n×3 [m]
  std::vector<Collider> colliders = {};   ///< in the order of the scene
  Vertices velocities = {};               ///< n×3 [m/s]; empty unless asked for
  std::optional<Energies> energies = {};  ///< absent unless asked for
  int iterations = 0;                     ///< iterations of the step that contains or ends at this moment
};

/// Report of how a step was computed.
struct StepReport {
  int iterations = 0;              ///< linear solves; 0 for a method that has none
  bool converged = true;           ///< true if the stopping rule and every motion filter converged within their limits
  double kept = 1;                 ///< fraction of the path to the last iterate that the step kept, see BackwardEuler
  double rise = 0;                 ///< largest increase of g in an iteration beyond rounding [J]: a fault
  bool redone = false;             ///< true if SDIRK2 gained energy, so that backward Euler took the step instead
  std::int64_t substeps = 1;       ///< number of substeps, see SubstepScheme
  std::optional<double> estimate;  ///< error added by the step [m], if an accuracy is set
};

}  // namespace drape
