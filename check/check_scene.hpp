#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "check/compare_motion.hpp"
#include "check/golden.hpp"
#include "check/report.hpp"
#include "drape/core/error.hpp"
#include "drape/render/settings.hpp"
#include "drape/scene/scene.hpp"
#include "run/progress.hpp"

namespace drape {

/// Condition for writing goldens during a check.
enum class UpdateMode {
  all,      ///< always
  missing,  ///< if there is none; the check fails nevertheless
  none
};

/// Options of a scene's check.
struct CheckOptions {
  std::vector<int> frames = {};  ///< numbers of golden frames to compare; empty: all
  GlBackend backend = GlBackend::automatic;
  bool end_to_end = false;  ///< also run the whole motion and draw it
  UpdateMode update = UpdateMode::missing;
  std::size_t threads = 0;  ///< threads for windows; 0: one per processor
  /// Folder of the report, for animations and candidates of failed scenes; empty: none are made.
  std::filesystem::path artefacts = {};
  /// Overrides of the scenes' values, as "--set cloth.mass=2"; their results cannot become golden.
  std::string overrides = {};
};

/// The result of bless_scene().
struct Blessing {
  std::filesystem::path folder;
  int frames = 0;
  std::uintmax_t size = 0;  ///< [bytes]
};

/// A golden in memory.
struct Recording {
  Golden golden;
  std::vector<Png> pictures;  ///< pictures of its frames
};

/// Runs a scene, or reads its motion, and draws the compared frames.
/// @param recorded the motion; null: the scene is simulated
/// @returns nothing if stopped
/// @throws DivergedError, UsageError, OutputError
std::optional<Recording> record_scene(const LoadedScene& scene, const CheckSettings& settings, GlBackend backend,
                                      const std::stop_token& stop, Progress& progress,
                                      PlayedMotion* recorded = nullptr);

/// Records a scene's golden and replaces an older one.
/// @param settings  Scene::check with the command line's changes
/// @param recorded  as for record_scene()
/// @returns nothing if stopped; then nothing is written
/// @throws UsageError early if another file is in the golden's place, see has_golden()
/// @throws DivergedError, UsageError, OutputError
std::optional<Blessing> bless_scene(const LoadedScene& scene, const CheckSettings& settings, GlBackend backend,
                                    const std::stop_token& stop, Progress& progress, PlayedMotion* recorded = nullptr);

/// Compares a scene with its golden.
/// @param name     of the scene in the report
/// @param recorded as for record_scene(); its motion is compared as a whole, its time is ignored
/// @throws UsageError if the golden is damaged or lacks a frame; DivergedError, OutputError
SceneResult check_scene(const LoadedScene& scene, const std::string& name, const CheckSettings& settings,
                        const CheckOptions& options, const std::stop_token& stop, Progress& progress,
                        PlayedMotion* recorded = nullptr);

/// Returns the result of a scene for which check_scene() threw this error.
SceneResult unjudged_scene(const LoadedScene& scene, const std::string& name, const CheckSettings& settings,
                           const Error& error);

/// Measures the CPU time of a scene's setup and first steps, relative to a fixed calibration loop that alternates with
/// it. Returns the median of several turns.
/// @param steps of the measured run; 0: as many as a measurable time needs, at most the whole motion
/// @returns nothing if stopped
/// @throws DivergedError
std::optional<GoldenTime> measure_step_time(const Scene& scene, std::int64_t steps, const std::stop_token& stop);

/// Compares a scene's computing time with the golden's. Repeats the measurement several times if the limit is exceeded,
/// so that a busy machine does not fail a check.
/// @param limit largest accepted ratio of the two times
/// @returns nothing if within the limit or stopped
/// @throws DivergedError
std::optional<SlowSteps> time_mismatch(const Scene& scene, const GoldenTime& golden, double limit,
                                       const std::stop_token& stop);

}  // namespace drape
