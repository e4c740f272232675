#pragma once

// Example:
//   drape::Effects effects{drape::Bending{.rigidity = 1e-4}};

#include <optional>

#include "sim/effects/effect.hpp"

namespace drape {

/// Resistance to bending: an energy of the curvature, "cross" springs, or both; at least one must be given.
struct Bending {
  static constexpr std::string_view name = "bending";
  static constexpr EffectCost cost{.evaluated = 20e-9, .solved = 50e-9};

  /// D [N·m], above 0: rolled to the radius R, an area A stores ½·D·A/R².
  std::optional<double> rigidity = {};
  /// Of springs between the vertices opposite to each inner edge [N/m], above 0.
  std::optional<double> cross_stiffness = {};

  void describe(Keys& keys);
  void check(const SimulationSettings& settings, const ProblemSink& problem) const;
  void install(System& system) const;
};

}  // namespace drape
