#pragma once

#include <optional>

#include "sim/schemes/field_kick.hpp"
#include "sim/schemes/scheme.hpp"
#include "sim/spring_network.hpp"

namespace drape {

/// Symplectic (semi-implicit) Euler: v += h·a(x), velocity fields by FieldKick, the corrections, x += h·v.
class SemiImplicitEuler final : public Scheme {
 public:
  /// @throws UsageError if the system has energies that only implicit methods support
  explicit SemiImplicitEuler(const System& system);
  StepReport advance(State& state, StepForces& forces) override;

 private:
  const System& system_;
  SpringNetwork springs_;
  Eigen::VectorXd pull_;  // −h/m of each vertex, 0 on pins [s/kg]
  Vertices force_;        // plus those of energies; empty without [N]
  Vertices before_;       // velocities before the kick, if there are fields [m/s]
  std::optional<FieldKick> fields_;
};

}  // namespace drape
