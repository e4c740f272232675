#pragma once

#include "sim/schemes/minimising_scheme.hpp"

namespace drape {

/// Backward (implicit) Euler as a minimisation: x' = argmin g, v' = (x' − x)/h, then the corrections. It gains no
/// energy but what EnergyBooks tolerates.
///
/// Of a cloth that nothing holds every solve ends with balance_momentum().
class BackwardEuler final : public MinimisingScheme {
 public:
  BackwardEuler(const System& system, const MakeSolver& make_solver);

  StepReport advance(State& state, StepForces& forces) override;

 private:
  /// Goes back until the step gains nothing, on a way that nothing is in; returns what part of it is left.
  /// @param held whether contacts hold the cloth
  double shed(bool held);

  EnergyBooks books_;
};

}  // namespace drape
