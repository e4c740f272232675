#pragma once

#include <span>
#include <stop_token>
#include <vector>

#include "check/compare_motion.hpp"
#include "check/rounding.hpp"
#include "motion/reader.hpp"
#include "motion/vertex_order.hpp"
#include "run/step_observer.hpp"
#include "scene/scene.hpp"

namespace drape {

/// A recorded motion in place of a simulation, by drape or another program.
class PlayedMotion {
 public:
  /// @param reader outlives the motion
  explicit PlayedMotion(MotionReader& reader) : reader_(reader) {}

  /// Checks that there is a state for every step of the scene. @throws UsageError that names the motion
  void require_every_step(const Scene& scene) const;

  /// Reorders the vertices from now on: vertex i is the file's vertex order[i].
  void set_order(VertexOrder order) { order_ = std::move(order); }

  /// Returns the state at the end of a step.
  [[nodiscard]] State state(std::int64_t step);
  [[nodiscard]] Energies energies(std::int64_t step) { return reader_.row(step).energies; }

 private:
  MotionReader& reader_;
  VertexOrder order_;  // empty: as in the file
};

/// Passes a recorded motion to observers in windows, like run_chained() does with a simulation. Returns early when a
/// stop is requested.
/// @param simulation of the motion's scene; it takes each state without computing a step
void play_chained(PlayedMotion& motion, Simulation& simulation, std::span<const std::int64_t> starts,
                  const RoundingUnits& quanta, std::span<StepObserver* const> observers, const std::stop_token& stop);

/// Returns the compared positions of a golden window and those of a recorded motion, like rerun_window().
std::vector<WindowPositions> played_window(PlayedMotion& motion, const Golden& golden, std::size_t window);

}  // namespace drape
