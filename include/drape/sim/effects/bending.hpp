#pragma once

// Example:
//   drape::Effects effects{drape::Bending{.rigidity = 1e-4}};

#include <optional>
#include <string>

#include "drape/core/warp_weft.hpp"
#include "drape/sim/effects/effect.hpp"

namespace drape {

/// Resistance to bending: a curvature energy, "cross" springs, or both; at least one must be given.
struct Bending {
  static constexpr std::string_view name = "bending";
  static constexpr bool repeatable = true;
  static constexpr EffectCost cost{.evaluated = 20e-9, .solved = 50e-9};

  /// Flexural rigidity D [N·m], above 0: an area A rolled to the radius R stores ½·D·A/R².
  /// Along warp and weft, or one number for all directions.
  std::optional<WarpWeft> rigidity = {};
  /// Stiffness of springs between the vertices opposite to each inner edge [N/m], above 0.
  std::optional<double> cross_stiffness = {};
  std::string cloth = {};  ///< name of the cloth that it acts on; empty: all

  void describe(Keys& keys);
  void check(const SimulationSettings& settings, const ProblemSink& problem) const;
  void install(System& system) const;
};

}  // namespace drape
