#pragma once

#include <optional>
#include <string>
#include <vector>

#include "run/step_observer.hpp"
#include "sim/start_overlap.hpp"

namespace drape {

/// Observer of the separation of a cloth that begins inside or across an obstacle, if the effect allows such a start.
/// It tests the cloth after every step until no overlap is left. It does not change the motion.
class Separation final : public StepObserver {
 public:
  /// Forwards all calls to another observer.
  void tell_also(StepObserver& next) { next_ = &next; }

  void begin(const Simulation& simulation) override;
  void replay(const StepRow& row, double time, double seconds) override;
  void after_step(const Simulation& simulation, const StepReport& report, double seconds) override;

  /// Returns a line per overlap: "begins with 12 vertices inside the body, up to 0.03 m deep: separated after 0.2 s".
  [[nodiscard]] std::vector<std::string> lines() const;

 private:
  struct Part {
    std::size_t effect;
    std::string text;
    std::optional<double> separated;  // first time without overlap [s]
  };
  std::vector<Part> parts_;
  StepObserver* next_ = nullptr;
};

}  // namespace drape
