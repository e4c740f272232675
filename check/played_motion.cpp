#include "check/played_motion.hpp"

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/text.hpp"

namespace drape {

void PlayedMotion::require_every_step(const Scene& scene) const {
  const auto states = static_cast<std::int64_t>(reader_.states());
  if (reader_.last_step() == scene.step_count() && states == scene.step_count() + 1) return;
  throw UsageError(
      fmt::format("{}: it has {} states of {} steps, and a check needs all: give the frames' rate with fps, or record "
                  "the motion with --every 1",
                  shown(scene.file), states, scene.step_count()));
}

State PlayedMotion::state(std::int64_t step) {
  State state = reader_.state(static_cast<std::size_t>(step));
  if (order_.empty()) return state;
  state.x = in_order(state.x, order_);
  state.v = in_order(state.v, order_);
  return state;
}

void play_chained(PlayedMotion& motion, Simulation& simulation, std::span<const std::int64_t> starts,
                  const RoundingUnits& quanta, std::span<StepObserver* const> observers, const std::stop_token& stop) {
  simulation.restore(motion.state(0));
  std::int64_t step = 0;
  for (const std::int64_t end : starts.subspan(1)) {
    for (StepObserver* observer : observers) observer->begin(simulation);
    while (step < end) {
      if (stop.stop_requested()) return;
      simulation.restore(motion.state(++step));
      for (StepObserver* observer : observers) observer->after_step(simulation, {}, 0);
    }
    const RoundingUnits next = end == starts.back() ? quanta.at_end() : quanta;
    simulation.restore(rounded(simulation.state(), simulation.cloth().pins, next));
  }
  for (StepObserver* observer : observers) observer->begin(simulation);
}

std::vector<WindowPositions> played_window(PlayedMotion& motion, const Golden& golden, std::size_t index) {
  const GoldenWindow& window = golden.windows[index];
  std::vector<WindowPositions> positions;
  const auto add = [&](std::int64_t step, const Vertices& x) { positions.push_back({step, x, motion.state(step).x}); };
  add(window.start.step, window.start.x);
  if (window.middle.size() > 0) add(window.middle_step(), window.middle);
  add(window.last_step(), golden.windows[index + 1].start.x);
  return positions;
}

}  // namespace drape
