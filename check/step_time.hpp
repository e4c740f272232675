#pragma once

#include <cstdint>
#include <optional>
#include <stop_token>
#include <string>

#include "check/golden.hpp"
#include "drape/scene/scene.hpp"

namespace drape {

/// Measures the CPU time of a scene's setup and first steps, relative to a fixed calibration loop that alternates with
/// it. Returns the median of several turns.
/// @param steps of the measured run; 0: as many as a measurable time needs, at most the whole motion
/// @returns nothing if stopped
/// @throws DivergedError
std::optional<GoldenTime> measure_step_time(const Scene& scene, std::int64_t steps, const std::stop_token& stop);

/// Compares a scene's time with its golden one. Repeats the measurement several times if the limit is exceeded, so that
/// a busy machine does not fail a check.
/// @param limit largest accepted ratio of the two
/// @returns nothing if within the limit or stopped
/// @throws DivergedError
std::optional<SlowSteps> time_mismatch(const Scene& scene, const GoldenTime& golden, double limit,
                                       const std::stop_token& stop);

}  // namespace drape
