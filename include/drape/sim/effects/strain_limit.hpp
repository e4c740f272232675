#pragma once

// Example:
//   drape::Effects effects{drape::StrainLimit{.max_stretch = 1.05}};

#include <optional>
#include <string>

#include "drape/sim/effects/effect.hpp"

namespace drape {

/// Limits on the length of the cloth's edges, in multiples of their rest length.
struct StrainLimit {
  static constexpr std::string_view name = "strain_limit";
  static constexpr bool repeatable = true;
  static constexpr EffectCost cost{.evaluated = 0.5e-6, .solved = 0.8e-6};

  double max_stretch = 1.1;                ///< upper limit in rest lengths; at least 1
  std::optional<double> min_stretch = {};  ///< lower limit in rest lengths, 0 to 1; default: none
  int iterations = 1000;                   ///< maximum number of sweeps over the edges in a step
  double tolerance = 1e-3;                 ///< relative violation of a limit that is accepted
  std::string cloth = {};                  ///< name of the cloth that it acts on; empty: all

  void describe(Keys& keys);
  void check(const SimulationSettings& settings, const ProblemSink& problem) const;
  void install(System& system) const;
};

}  // namespace drape
