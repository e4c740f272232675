#pragma once

#include <cstddef>
#include <functional>
#include <stop_token>
#include <vector>

#include "check/golden.hpp"
#include "check/report.hpp"

namespace drape {

/// Computes windows of a golden motion again, each from its golden state, on several threads, and compares every step.
/// The window at step 0 begins in the simulation's own initial state instead, so that a change of that is seen; there a
/// vertex is as far off as its velocity would lead it within the window, too.
/// @param tolerance how far a vertex may be from its golden place [m]; 0: the bits must be the same
/// @param done      called after every window, from the thread that computed it
/// @returns a result for each window; those that a stop prevented are empty
std::vector<WindowResult> compare_windows(const SimulationSettings& settings, const std::vector<GoldenWindow>& windows,
                                          double tolerance, std::size_t threads, const std::stop_token& stop,
                                          const std::function<void()>& done);

/// Compares the states in which a whole motion passed through the windows' starts with the golden ones: positions, and
/// velocities as the way they lead within a step.
/// @param actual windows of the same plan as `golden`
/// @param step   h [s]
std::vector<WindowResult> compare_starts(const std::vector<GoldenWindow>& golden,
                                         const std::vector<GoldenWindow>& actual, double step, double tolerance);

/// The positions after each step of a window computed again, its start first; fewer if it diverges.
std::vector<Vertices> rerun_window(const SimulationSettings& settings, const GoldenWindow& window);

/// "the motion changed at step 37 by up to 2.1 mm at vertex 213"; empty if it did not change.
std::string describe_motion(const std::vector<WindowResult>& windows);

}  // namespace drape
