#pragma once

#include <cstdint>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "check/compare_motion.hpp"
#include "check/draw_frames.hpp"
#include "check/golden.hpp"
#include "drape/scene/scene.hpp"
#include "run/progress.hpp"

namespace drape {

using Words = std::vector<std::uint64_t>;

/// Serialises words as byte planes, most significant plane first, compressed by zlib. A line with the unpacked size
/// precedes them.
std::string pack_words(const Words& words);

/// Reads words written by pack_words().
/// @param most largest number of words; larger data are rejected before decompression
/// @throws std::invalid_argument if the bytes are invalid
Words unpack_words(std::string_view bytes, std::uint64_t most);

/// Serialises the windows of a golden motion and the positions of its pictures as motion.bin, without loss. A row of a
/// vector field is stored in multiples of the field's quantum, or as raw bits if it is not a multiple. Rows are stored
/// as differences from a prediction by neighbouring vertices. Body positions are stored as their nonzero second
/// differences. All become 64-bit words, see pack_words().
std::string pack_motion(const Golden& golden);

/// Reads motion.bin into the windows and frame positions of a golden whose other members are known. Every number read
/// is finite. The other members limit the size.
/// @throws std::invalid_argument if the bytes are invalid
void unpack_motion(std::string_view bytes, Golden& golden);

/// Returns the largest size of a golden's motion [bytes].
std::uint64_t most_motion_bytes(const Golden& golden);

/// GoldenFrame::why of a frame that drape did not choose.
inline constexpr const char* named_frame = "named by the scene";

/// A plan for recording a scene's motion.
struct RecordPlan {
  std::vector<ChosenFrame> frames;  ///< frames to compare, ascending
  std::int64_t window_steps = 1;
  RoundingUnits quanta;
};

/// Plans the recording by the scene's [check] table. If the table has no frames, runs the motion and chooses
/// significant ones.
/// @param recorded the motion to read; null: the scene is simulated
/// @throws UsageError if the film has no such frame
/// @throws DivergedError
/// @returns nothing if stopped
std::optional<RecordPlan> plan_recording(const LoadedScene& scene, const CheckSettings& settings,
                                         const std::stop_token& stop, Progress& progress,
                                         PlayedMotion* recorded = nullptr);

/// Returns the plan by which a golden was recorded.
RecordPlan plan_of(const Golden& golden);

/// Runs a scene's motion, or reads a recorded one, and places the camera.
/// @returns a golden without pictures, date and machine; nothing if stopped
/// @throws DivergedError
std::optional<Golden> record_motion(const LoadedScene& scene, const CheckSettings& settings, const RecordPlan& plan,
                                    const std::stop_token& stop, Progress& progress, PlayedMotion* recorded = nullptr);

/// Returns the film settings to store in a scene's golden.
GoldenFilm film_of(const Scene& scene);

/// Returns the size of a scene's golden pictures [pixels].
Eigen::Vector2i picture_size(const Scene& scene, const CheckSettings& settings);

/// Computes the camera views as if the compared frames were the whole motion. They change only with the camera, the
/// visible scene, or the algorithm that places the camera.
/// @returns a view per frame
std::vector<View> views_of_frames(const Scene& scene, const Eigen::Vector2i& size,
                                  const std::vector<GoldenFrame>& frames);

}  // namespace drape
