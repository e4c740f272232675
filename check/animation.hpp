#pragma once

#include <filesystem>
#include <string>

#include "check/compare_motion.hpp"
#include "check/golden.hpp"
#include "check/report.hpp"
#include "drape/render/settings.hpp"
#include "drape/scene/scene.hpp"
#include "output/gif_encoder.hpp"
#include "reports/players.hpp"

namespace drape {

/// A film of a difference; without bytes if there is none.
struct DifferenceAnimation {
  PageFilm film;
  html::PlayedMotion expected, actual;  ///< states of a changed motion, for interactive viewing
};

/// Makes a looping GIF with expected picture, actual picture and difference side by side. For a changed motion it shows
/// the compared steps of the first changed windows, otherwise the compared frames around the first changed picture.
/// @param folder  of the report; the file is NAME/difference.gif
/// @throws OutputError
DifferenceAnimation difference_animation(const Scene& scene, const Golden& golden, const SceneResult& result,
                                         PlayedMotion* recorded, GlBackend backend,
                                         const std::filesystem::path& folder);

}  // namespace drape
