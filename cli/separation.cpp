#include "cli/separation.hpp"

#include <fmt/format.h>

namespace drape {

void Separation::begin(const Simulation& simulation) {
  parts_.clear();
  for (const StartOverlap& start : start_overlaps(simulation.settings())) {
    if (!start.overlap.contact) continue;
    parts_.push_back({start.effect, describe(start, simulation.settings()), std::nullopt});
  }
  if (next_ != nullptr) next_->begin(simulation);
}

void Separation::replay(const StepRow& row, double time, double seconds) {
  if (next_ != nullptr) next_->replay(row, time, seconds);
}

void Separation::after_step(const Simulation& simulation, const StepReport& report, double seconds) {
  if (next_ != nullptr) next_->after_step(simulation, report, seconds);
  for (Part& part : parts_) {
    if (part.separated) continue;
    const double time = simulation.time();
    if (!find_overlap(simulation.settings(), part.effect, simulation.state().x, time)) part.separated = time;
  }
}

std::vector<std::string> Separation::lines() const {
  std::vector<std::string> lines;
  for (const Part& part : parts_) {
    lines.push_back(fmt::format("begins with {}: {}", part.text,
                                part.separated ? fmt::format("separated after {:.3g} s", *part.separated)
                                               : std::string("not separated at the end")));
  }
  return lines;
}

}  // namespace drape
