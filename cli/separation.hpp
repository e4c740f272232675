#pragma once

#include <optional>
#include <string>
#include <vector>

#include "run/step_observer.hpp"
#include "sim/start_overlap.hpp"

namespace drape {

/// Watches how what a cloth begins inside or across is separated, where effects allow such a start. It looks at the
/// cloth after every step until nothing is left, and changes nothing of the motion.
class Separation final : public StepObserver {
 public:
  /// Has another observer told all that this one is.
  void tell_also(StepObserver& next) { next_ = &next; }

  void begin(const Simulation& simulation) override;
  void replay(const StepRow& row, double time, double seconds) override;
  void after_step(const Simulation& simulation, const StepReport& report, double seconds) override;

  /// "begins with 12 vertices inside the body, up to 0.03 m deep: separated after 0.2 s", of each overlap.
  [[nodiscard]] std::vector<std::string> lines() const;

 private:
  struct Part {
    std::size_t effect;
    std::string text;
    std::optional<double> separated;  // when nothing of it was found for the first time [s]
  };
  std::vector<Part> parts_;
  StepObserver* next_ = nullptr;
};

}  // namespace drape
