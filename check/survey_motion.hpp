#pragma once

#include <optional>
#include <stop_token>

#include "check/choose_frames.hpp"
#include "check/played_motion.hpp"
#include "check/rounding.hpp"
#include "run/progress.hpp"
#include "scene/scene.hpp"

namespace drape {

/// Runs a scene's golden motion, see run_chained(), and collects the facts of its film.
/// @param recorded the motion to read; null: the scene is simulated
/// @returns nothing if stopped
/// @throws DivergedError
std::optional<FilmFacts> survey_motion(const Scene& scene, std::int64_t window_steps, const RoundingUnits& quanta,
                                       const std::stop_token& stop, Progress& progress,
                                       PlayedMotion* recorded = nullptr);

}  // namespace drape
