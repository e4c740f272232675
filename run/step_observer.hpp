#pragma once

#include "sim/simulation.hpp"

namespace drape {

/// Something that watches a simulation from the thread that runs it.
class StepObserver {
 public:
  virtual ~StepObserver() = default;
  /// Before the first step.
  virtual void begin(const Simulation& /*simulation*/) {}
  /// After every step.
  /// @param seconds that the step took
  virtual void after_step(const Simulation& simulation, const StepReport& report, double seconds) = 0;
};

}  // namespace drape
