#pragma once

#include <filesystem>
#include <optional>
#include <stop_token>
#include <vector>

#include "check/golden.hpp"
#include "check/played_motion.hpp"
#include "check/report.hpp"
#include "core/error.hpp"
#include "render/backend.hpp"
#include "run/progress.hpp"
#include "scene/scene.hpp"

namespace drape {

/// When a check writes goldens.
enum class UpdateMode {
  all,      ///< always
  missing,  ///< where there is none; the check fails all the same
  none
};

/// What a check of a scene should do.
struct CheckOptions {
  std::vector<int> frames = {};  ///< compare only these of the golden frames; empty: all of them
  GlBackend backend = GlBackend::automatic;
  bool end_to_end = false;  ///< run the whole motion and draw it as well
  UpdateMode update = UpdateMode::missing;
  std::size_t threads = 0;  ///< that compute windows; 0: as many as the processor has
  /// The report's folder, for the animation of a failed scene and what it would be accepted as; empty: neither is made.
  std::filesystem::path artefacts = {};
  /// The scenes have other values than their files, as "--set cloth.mass=2": what they give cannot become golden.
  std::string overrides = {};
};

/// What bless did.
struct Blessing {
  std::filesystem::path folder;
  int frames = 0;
  std::uintmax_t size = 0;  ///< [bytes]
};

/// A golden that is not written yet.
struct Recording {
  Golden golden;
  std::vector<Png> pictures;  ///< of its frames
};

/// Runs a scene, or reads its motion, and draws the compared frames.
/// @param recorded the motion; null: the scene is simulated
/// @returns nothing if it was stopped
/// @throws DivergedError, UsageError, OutputError
std::optional<Recording> record_scene(const Scene& scene, const CheckSettings& settings, GlBackend backend,
                                      const std::stop_token& stop, Progress& progress,
                                      PlayedMotion* recorded = nullptr);

/// Records a scene's golden in the place of an older one.
/// @param settings  Scene::check with what the command line says
/// @param recorded  as of record_scene()
/// @returns nothing if it was stopped; then nothing has been written
/// @throws UsageError before anything is computed if something else stands in that place, see has_golden()
/// @throws DivergedError, UsageError, OutputError
std::optional<Blessing> bless_scene(const Scene& scene, const CheckSettings& settings, GlBackend backend,
                                    const std::stop_token& stop, Progress& progress, PlayedMotion* recorded = nullptr);

/// Compares a scene with its golden.
/// @param name     of the scene in the report
/// @param recorded as of record_scene(); its motion is compared as a whole, and its time is not
/// @throws UsageError if the golden is damaged or has no such frames; DivergedError, OutputError
SceneResult check_scene(const Scene& scene, const std::string& name, const CheckSettings& settings,
                        const CheckOptions& options, const std::stop_token& stop, Progress& progress,
                        PlayedMotion* recorded = nullptr);

/// The result of a scene that check_scene() throws for.
SceneResult unjudged_scene(const Scene& scene, const std::string& name, const CheckSettings& settings,
                           const Error& error);

}  // namespace drape
