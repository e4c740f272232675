#pragma once

#include "sim/settings.hpp"

namespace drape {

/// The most threads that share a step unless more are asked for: with more, what each loop costs to divide grows, and
/// the memory's bandwidth is used up (docs/performance.md).
inline constexpr int most_automatic_threads = 16;

/// The same settings with the threads that share the steps of a run.
/// @param asked so many, or 0: as many as gain something and find a processor of their own, and only while they do
/// @param drawn whether frames are drawn and encoded meanwhile, for which a processor is left
SimulationSettings with_threads(SimulationSettings settings, int asked, bool drawn);

}  // namespace drape
