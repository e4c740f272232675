#pragma once

#include <memory>
#include <utility>

#include "sim/schemes/scheme.hpp"

namespace drape {

/// An explicit scheme that divides each step into equal substeps: System::substeps of System::step seconds. A substep
/// is a step in every respect except that State::step counts it differently.
class DividedStep final : public Scheme {
 public:
  /// @param scheme for the same system
  DividedStep(const System& system, std::unique_ptr<Scheme> scheme) : system_(system), scheme_(std::move(scheme)) {}

  StepReport advance(State& state, StepForces& forces) override;

 private:
  const System& system_;
  std::unique_ptr<Scheme> scheme_;
};

}  // namespace drape
