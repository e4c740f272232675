#pragma once

#include <cstdint>
#include <optional>
#include <stop_token>
#include <string>

#include "check/golden.hpp"
#include "scene/scene.hpp"

namespace drape {

/// Measures the processor time of setting a scene up and of its first steps, as a ratio to a loop that does not change
/// between versions and runs in turns with it. The median of several turns.
/// @param steps of the measured run; 0: as many as take long enough to be measured, at most the whole motion
/// @returns nothing if it was stopped
/// @throws DivergedError
std::optional<GoldenTime> measure_step_time(const Scene& scene, std::int64_t steps, const std::stop_token& stop);

/// Compares a scene's time with its golden one. Where the limit is exceeded it measures again, several times, so that a
/// busy machine does not fail a check.
/// @param limit largest accepted ratio of both
/// @returns "the first 40 steps take 1.52 times as long as …"; empty if they do not, or if it was stopped
/// @throws DivergedError
std::string time_mismatch(const Scene& scene, const GoldenTime& golden, double limit, const std::stop_token& stop);

}  // namespace drape
