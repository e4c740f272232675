#pragma once

// Example:
//   drape::Effects effects{drape::Ground{.height = -1, .friction = 0.3}};

#include <Eigen/Core>
#include <optional>

#include "sim/effects/effect.hpp"
#include "sim/effects/response.hpp"

namespace drape {

struct ContactLaw;

/// A plane that pushes the cloth out of the half-space below it, as a sphere does.
struct Ground {
  static constexpr std::string_view name = "ground";
  static constexpr EffectCost cost{.evaluated = 20e-9, .solved = 0.3e-6};
  static constexpr bool touches = true;
  static constexpr bool repeatable = true;

  double height = 0;                                  ///< its distance from the origin along the normal [m]
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< out of it, of any length but 0
  double thickness = 0.02;                            ///< of the layer above it in which it pushes [m]

  std::optional<double> stiffness = {};   ///< of the push [1/s²]; absent: usual_stiffness, if anything pushes
  std::optional<Response> response = {};  ///< absent: an explicit push with `stiffness`, else see response_or_usual()
  double friction = 0.5;                  ///< Coulomb's coefficient
  std::optional<double> restitution = 0;  ///< of impacts, 0 to 1; without one the push gives back what it takes

  void describe(Keys& keys);
  void check(const SimulationSettings& settings, const ProblemSink& problem) const;
  void install(System& system) const;

 private:
  /// @param impulses whether the method is explicit, see response_or_usual()
  [[nodiscard]] ContactLaw law(bool impulses) const;
};

}  // namespace drape
