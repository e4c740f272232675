#pragma once

// Example:
//   drape::Effects effects{drape::StrainLimit{.max_stretch = 1.05}};

#include <optional>
#include <string>

#include "sim/effects/effect.hpp"

namespace drape {

/// Keeps the cloth's edges from becoming longer, or shorter, than a multiple of their rest length.
struct StrainLimit {
  static constexpr std::string_view name = "strain_limit";
  static constexpr EffectCost cost{.evaluated = 0.5e-6, .solved = 0.8e-6};

  double max_stretch = 1.1;                ///< longest, in rest lengths; at least 1
  std::optional<double> min_stretch = {};  ///< shortest, likewise, from 0 to 1; without it there is no such limit
  int iterations = 1000;                   ///< sweeps over the edges in a step, at most
  double tolerance = 1e-3;                 ///< the fraction by which a limit may be exceeded

  void describe(Keys& keys);
  void check(const SimulationSettings& settings, const ProblemSink& problem) const;
  void install(System& system) const;
};

}  // namespace drape
