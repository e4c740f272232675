#pragma once

// Example:
//   drape::Effects effects{drape::Gravity{.acceleration = {0, 0, -1.62}}};

// Example:
//   drape::Effects effects{drape::Wind{.acceleration = {0, 3, 0}}};

// Example:
//   drape::Effects effects{drape::Field{.acceleration = {"-x", "-y", "0"}}};

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>

#include "drape/sim/effects/effect.hpp"

namespace drape {

/// Uniform acceleration whose potential energy is reported as Energies::gravity.
struct Gravity {
  static constexpr std::string_view name = "gravity";

  Eigen::Vector3d acceleration{0, 0, -9.8};  ///< [m/s²]

  void describe(Keys& keys);
  void install(System& system) const;
};

/// Second uniform acceleration beside Gravity. For the force of moving air see Air.
struct Wind {
  static constexpr std::string_view name = "wind";
  static constexpr EffectCost cost{.evaluated = 10e-9, .solved = 10e-9};

  Eigen::Vector3d acceleration = Eigen::Vector3d::Zero();  ///< [m/s²]

  void describe(Keys& keys);
  void install(System& system) const;
};

/// Acceleration field by formula, Field{.acceleration = {"-x", "-y", "0"}}: centrifugal, an attractor, a swirl.
struct Field {
  static constexpr std::string_view name = "field";
  static constexpr EffectCost cost{.evaluated = 0.1e-6, .solved = 0.3e-6};
  static constexpr bool repeatable = true;

  /// Components along x, y and z, each a formula in x, y, z, t, vx, vy and vz, see FormulaField [m/s²].
  std::array<std::string, 3> acceleration = {"0", "0", "0"};
  /// Upper bound on the spectral norm of the Jacobian ∂a/∂x [1/s²]. Explicit methods need it for formulas that depend
  /// on the position, to find their largest stable step.
  std::optional<double> stiffness_bound = {};

  void describe(Keys& keys);
  void check(const SimulationSettings& settings, const ProblemSink& problem) const;
  /// @throws std::invalid_argument if a formula is invalid
  void install(System& system) const;
};

}  // namespace drape
