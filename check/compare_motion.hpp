#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <stop_token>
#include <vector>

#include "check/draw_frames.hpp"
#include "check/golden.hpp"
#include "check/name_difference.hpp"
#include "check/report.hpp"
#include "drape/scene/scene.hpp"
#include "motion/reader.hpp"
#include "motion/vertex_order.hpp"
#include "run/progress.hpp"
#include "run/statistics.hpp"

namespace drape {

/// Simulates the golden motion in windows. Each window starts from the rounded end state of the previous one. Calls
/// every observer's begin() for each window, and once more at the end. Returns early when a stop is requested.
/// @param simulation before its first step
/// @param starts     first steps of the windows, and the last step, see window_starts()
/// @throws DivergedError after the observers saw the last finite step
void run_chained(Simulation& simulation, std::span<const std::int64_t> starts, const RoundingUnits& quanta,
                 std::span<StepObserver* const> observers, const std::stop_token& stop);

/// Simulates each window of a golden motion from its golden state, on several threads, and compares it. Every step is
/// compared by hash, bodies and group_means(). The middle and end of a window are also compared by vertex positions. A
/// velocity difference at the end counts as the distance that it causes within a step. The first window starts from the
/// simulation's own initial state, to detect changes in it. There a velocity difference counts as the distance that it
/// causes within the window.
/// @param tolerance largest distance of a vertex or body from its golden position [m]; 0: all bits must be equal
/// @param done      called after every window, on the thread that simulated it
/// @returns a result for each window; empty for windows skipped after a stop
std::vector<WindowResult> compare_windows(const SimulationSettings& settings, const Golden& golden, double tolerance,
                                          std::size_t threads, const std::stop_token& stop,
                                          const std::function<void()>& done);

/// Compares a motion recorded with the golden's RecordPlan, like compare_windows().
std::vector<WindowResult> compare_whole(const SimulationSettings& settings, const Golden& golden, const Golden& actual,
                                        double tolerance);

/// Positions of one step of a window.
struct WindowPositions {
  std::int64_t step = 0;
  Vertices golden, actual;  ///< [m]
};

/// Simulates a window again. Returns the positions of its compared steps, fewer if it diverges.
std::vector<WindowPositions> rerun_window(const SimulationSettings& settings, const Golden& golden, std::size_t window);

/// Returns "at step 37 the sphere is 2.1 mm from its golden position", or the like for another fault.
std::string describe_problem(const WindowProblem& problem);

/// Returns "the motion changed at step 37 by up to 2.1 mm at vertex 213"; empty if it did not change.
std::string describe_motion(const std::vector<WindowResult>& windows);

/// A motion recorded by drape or another program, used instead of a simulation.
class PlayedMotion {
 public:
  /// @param reader outlives the motion
  explicit PlayedMotion(MotionReader& reader) : reader_(reader) {}

  /// Checks that there is a state for every step of the scene.
  /// @throws UsageError that names the motion
  void require_every_step(const LoadedScene& scene) const;

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
/// @param simulation of the motion's scene; its state is set for each step, and it computes nothing
void play_chained(PlayedMotion& motion, Simulation& simulation, std::span<const std::int64_t> starts,
                  const RoundingUnits& quanta, std::span<StepObserver* const> observers, const std::stop_token& stop);

/// Returns the golden and the recorded positions of a window's compared steps, like rerun_window().
std::vector<WindowPositions> played_window(PlayedMotion& motion, const Golden& golden, std::size_t window);

/// Runs a scene's golden motion, see run_chained(), and returns the properties of its film's frames.
/// @param recorded the motion to read; null: the scene is simulated
/// @returns nothing if stopped
/// @throws DivergedError
std::optional<FilmFacts> survey_motion(const Scene& scene, std::int64_t window_steps, const RoundingUnits& quanta,
                                       const std::stop_token& stop, Progress& progress,
                                       PlayedMotion* recorded = nullptr);

}  // namespace drape
