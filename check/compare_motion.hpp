#pragma once

#include <cstddef>
#include <functional>
#include <stop_token>
#include <vector>

#include "check/golden.hpp"
#include "check/report.hpp"

namespace drape {

/// Computes the windows of a golden motion again, each from its golden state, on several threads, and compares every
/// step: by its hash, where everything is that moves the cloth, and half-way and at the end of each window the
/// positions. At its end, a velocity counts as the way it leads within a step. The first window begins in the
/// simulation's own initial state instead, so that a change of that is seen; there a velocity counts as its way within
/// the window.
/// @param tolerance how far a vertex or a body may be from its golden place [m]; 0: the bits must be the same
/// @param done      called after every window, from the thread that computed it
/// @returns a result for each window; those that a stop prevented are empty
std::vector<WindowResult> compare_windows(const SimulationSettings& settings, const Golden& golden, double tolerance,
                                          std::size_t threads, const std::stop_token& stop,
                                          const std::function<void()>& done);

/// Compares a whole motion, recorded by the plan of the golden one, with that one in the same way.
std::vector<WindowResult> compare_whole(const SimulationSettings& settings, const Golden& golden, const Golden& actual,
                                        double tolerance);

/// Positions of one step of a window.
struct WindowPositions {
  std::int64_t step = 0;
  Vertices golden, actual;  ///< [m]
};

/// The steps of a window whose positions are compared, computed again; fewer if it diverges.
std::vector<WindowPositions> rerun_window(const SimulationSettings& settings, const Golden& golden, std::size_t window);

/// "the motion changed at step 37 by up to 2.1 mm at vertex 213"; empty if it did not change.
std::string describe_motion(const std::vector<WindowResult>& windows);

}  // namespace drape
