#pragma once

#include <stop_token>
#include <utility>

#include "run/step_observer.hpp"

namespace drape {

/// Observer that prints every step's energies and iterations to standard output, then waits for a line of input.
class StepByStep final : public StepObserver {
 public:
  /// @param stop stop source; q requests a stop, and a stop from elsewhere ends the waiting
  explicit StepByStep(std::stop_source stop) : stop_(std::move(stop)) {}

  void begin(const Simulation& simulation) override;
  void after_step(const Simulation& simulation, const StepReport& report, double seconds) override;

 private:
  void wait_for_line();

  std::stop_source stop_;
  bool input_ended_ = false;
};

}  // namespace drape
