#pragma once

#include <cstddef>
#include <functional>
#include <stop_token>
#include <vector>

#include "check/golden.hpp"
#include "check/report.hpp"

namespace drape {

/// Simulates each window of a golden motion from its golden state, on several threads, and compares it. Each step is
/// compared by its hash and its bodies, the middle and the end of a window by vertex positions. A velocity difference
/// at the end counts as the distance that it causes within a step. The first window begins with the simulation's own
/// initial state, to detect a change of it. There a velocity difference counts as the distance within the window.
/// @param tolerance largest distance of a vertex or body from its golden position [m]; 0: all bits must be equal
/// @param done      called after every window, on the thread that simulated it
/// @returns a result for each window; empty for windows skipped after a stop
std::vector<WindowResult> compare_windows(const SimulationSettings& settings, const Golden& golden, double tolerance,
                                          std::size_t threads, const std::stop_token& stop,
                                          const std::function<void()>& done);

/// Compares a whole motion, recorded by the golden's plan, with the golden motion in the same way.
std::vector<WindowResult> compare_whole(const SimulationSettings& settings, const Golden& golden, const Golden& actual,
                                        double tolerance);

/// Positions of one step of a window.
struct WindowPositions {
  std::int64_t step = 0;
  Vertices golden, actual;  ///< [m]
};

/// Returns the compared steps of a window after a new simulation; fewer if it diverges.
std::vector<WindowPositions> rerun_window(const SimulationSettings& settings, const Golden& golden, std::size_t window);

/// Returns "the motion changed at step 37 by up to 2.1 mm at vertex 213"; empty if it did not change.
std::string describe_motion(const std::vector<WindowResult>& windows);

}  // namespace drape
