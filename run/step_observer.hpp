#pragma once

#include "motion/step_row.hpp"
#include "sim/simulation.hpp"

namespace drape {

/// Something that watches a simulation from the thread that runs it.
class StepObserver {
 public:
  virtual ~StepObserver() = default;
  /// Before the first step.
  virtual void begin(const Simulation& /*simulation*/) {}
  /// After that, where a run goes on: every step that was done before, and first of all the start, as step 0.
  /// @param time    its end [s]
  /// @param seconds that the step took
  virtual void replay(const StepRow& /*row*/, double /*time*/, double /*seconds*/) {}
  /// After every step.
  /// @param seconds that the step took
  /// @throws Interrupted, of several observers the first alone: the step is then taken back
  virtual void after_step(const Simulation& simulation, const StepReport& report, double seconds) = 0;
};

}  // namespace drape
