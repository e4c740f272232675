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

/// A motion that was recorded, in place of a simulation: by drape, or by another program.
class PlayedMotion {
 public:
  /// @param reader outlives it
  explicit PlayedMotion(MotionReader& reader) : reader_(reader) {}

  /// @throws UsageError that names the motion unless it has a state for every step of the scene
  void require_every_step(const Scene& scene) const;

  /// Has the vertices in another order from now on: vertex i is the one that the file has as order[i].
  void set_order(VertexOrder order) { order_ = std::move(order); }

  /// The state at the end of a step.
  [[nodiscard]] State state(std::int64_t step);
  [[nodiscard]] Energies energies(std::int64_t step) { return reader_.row(step).energies; }

 private:
  MotionReader& reader_;
  VertexOrder order_;  // empty: as in the file
};

/// Hands a motion to observers in windows, as run_chained() does one that is simulated. Returns early when a stop is
/// requested.
/// @param simulation of the motion's scene: it takes on each state, and computes no step
void play_chained(PlayedMotion& motion, Simulation& simulation, std::span<const std::int64_t> starts,
                  const Quanta& quanta, std::span<StepObserver* const> observers, const std::stop_token& stop);

/// The compared positions of a golden window with those that a motion has there, as rerun_window().
std::vector<WindowPositions> played_window(PlayedMotion& motion, const Golden& golden, std::size_t window);

}  // namespace drape
