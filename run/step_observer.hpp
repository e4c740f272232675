#pragma once

#include "motion/step_row.hpp"
#include "sim/simulation.hpp"

namespace drape {

/// An observer of a simulation, called from the simulating thread.
class StepObserver {
 public:
  virtual ~StepObserver() = default;
  /// Called before the first step.
  virtual void begin(const Simulation& /*simulation*/) {}
  /// Called after begin() in a resumed run, for every earlier step; the first call is the start, as step 0.
  /// @param time    end of the step [s]
  /// @param seconds computing time of the step [s]
  virtual void replay(const StepRow& /*row*/, double /*time*/, double /*seconds*/) {}
  /// Called after every step.
  /// @param seconds computing time of the step [s]
  /// @throws Interrupted only from the first of several observers; the step is then undone
  virtual void after_step(const Simulation& simulation, const StepReport& report, double seconds) = 0;
};

}  // namespace drape
