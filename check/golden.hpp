#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "check/name_difference.hpp"
#include "check/report.hpp"
#include "drape/render/image.hpp"
#include "drape/render/settings.hpp"
#include "drape/render/view.hpp"
#include "drape/scene/scene.hpp"
#include "drape/sim/simulation.hpp"

namespace drape {

/// The result of a step of the golden motion.
struct GoldenStep {
  std::uint32_t hash = 0;      ///< hash of every bit, see step_hash()
  std::vector<double> bodies;  ///< positions of bodies and pins, see body_numbers(), rounded to RoundingUnits::compared
  std::vector<double> groups;  ///< see group_means(), rounded to RoundingUnits::compared
};

/// A window of the golden motion: a state and the steps from it. It ends where the next one begins, apart from the
/// rounding of that state.
struct GoldenWindow {
  State start;                    ///< rounded by RoundingUnits, except in the first window
  std::vector<GoldenStep> steps;  ///< steps from start.step + 1 on; empty in the last window, which is the motion's end
  Vertices
      middle;  ///< positions after half of the steps, rounded to RoundingUnits::compared; empty below two steps [m]
  Energies energies;  ///< energies at the window's end [J]

  [[nodiscard]] std::int64_t last_step() const { return start.step + static_cast<std::int64_t>(steps.size()); }
  [[nodiscard]] std::int64_t middle_step() const { return start.step + static_cast<std::int64_t>(steps.size() / 2); }
};

/// A frame of the film whose picture is compared.
struct GoldenFrame {
  int frame = 0;            ///< number in the film
  double time = 0;          ///< time in the scene [s]
  std::string why;          ///< reason for its choice: "first contact with the sphere"
  View view = {};           ///< camera view, so that drawing does not need the whole motion
  Vertices x;               ///< positions in the picture, rounded by RoundingUnits [m]
  std::string pixels = {};  ///< hash of the picture, see pixel_hash(); set when it is written
};

/// Film settings that the compared pictures do not show, as they have their own size.
struct GoldenFilm {
  double fps = 25;
  double speed = 1;            ///< seconds of the scene per second of the film
  Eigen::Vector2i size{0, 0};  ///< [pixels]
  int samples = 4;             ///< samples per pixel
};

/// The chosen method for a scene that names none.
struct GoldenMethod {
  Method method = Method::quasi_newton;  ///< the fixed default in older versions
  std::optional<int> substeps;           ///< substeps per step of an explicit method
};

/// Computing time of the first steps.
struct GoldenTime {
  std::int64_t steps = 0;
  double ratio = 0;  ///< relative to the calibration loop, see measure_step_time()
};

/// The golden of a scene: the complete reference data of its checks.
struct Golden {
  std::string scene_digest;  ///< SceneSource::digest
  std::string date;          ///< "2026-01-31T12:00:00Z"
  Machine machine;
  Eigen::Vector2i size{0, 0};   ///< size of the pictures [pixels]
  double step = 0;              ///< step length h [s]
  std::int64_t step_count = 0;  ///< steps of the whole motion
  std::int64_t window_steps = 1;
  int vertex_count = 0;
  int row = 1;                         ///< index distance of neighbours in adjacent rows of a grid; 1 for other meshes
  int body_count = 0;                  ///< largest size of GoldenStep::bodies
  int group_count = 0;                 ///< groups of vertices, see group_means(); 0 in goldens of format 3
  double seconds_per_frame = 0;        ///< scene time from a frame to the next [s]
  std::optional<GoldenFilm> film;      ///< absent in goldens of older versions
  std::optional<GoldenMethod> method;  ///< absent if the scene names one
  std::optional<GoldenTime> time;      ///< absent unless the scene's [check] had a `time`
  RoundingUnits quanta;
  Camera camera;                      ///< camera settings of the scene
  std::vector<View> frames_views;     ///< views if the compared frames were the whole motion, see views_of_frames()
  std::vector<GoldenWindow> windows;  ///< consecutive; the last one is the motion's end
  std::vector<GoldenFrame> frames;    ///< ascending
};

/// Returns true if two cameras are equal to the last bit.
bool same_camera(const Camera& a, const Camera& b);

/// Returns a short hash of every bit of a simulation's positions and velocities, of the colliders' positions, and of
/// the list of pinned vertices.
std::uint32_t step_hash(const Simulation& simulation);

/// Returns the positions of all colliders and of the pins (evenly chosen ones of many). Each number has the tolerance
/// of a vertex coordinate.
std::vector<double> body_numbers(const Simulation& simulation);

/// Number of groups in newly recorded goldens.
inline constexpr int group_count = 4;

/// Divides the vertices at random into groups, always in the same way, and returns the mean position of each [m]. A
/// mean moves no further than the furthest of its vertices. Since the groups are random, the displacements of a
/// symmetric motion do not cancel.
/// @returns x, y and z of every group; zeros for a group without vertices
std::vector<double> group_means(const Vertices& x, int groups);

/// Returns the result of a simulation's last step, not rounded.
GoldenStep golden_step(const Simulation& simulation, int groups);

/// Returns "sphere", "ground" or "body".
const char* body_kind(const Collider& collider);

/// Returns the owner of body_numbers()[index]: "sphere 1", "ground 2", "pin 20".
std::string body_name(const Simulation& simulation, std::size_t index);

/// Returns a hash of a picture's pixels, as 16 hexadecimal digits, independent of the PNG compression.
std::string pixel_hash(const Image& picture);

/// Returns the first steps of a motion's windows, and its last step.
std::vector<std::int64_t> window_starts(std::int64_t step_count, std::int64_t window_steps);

/// Returns the `wanted` frames of a golden; empty: all.
/// @param folder of the golden, for the message
/// @throws UsageError if it has no such frame
std::vector<GoldenFrame> chosen_frames(const Golden& golden, const std::vector<int>& wanted,
                                       const std::filesystem::path& folder);

/// Returns the folder of a scene's golden, beside the scene: scenes/5.golden for scenes/5.toml.
std::filesystem::path golden_folder(const std::filesystem::path& scene_file);

/// Returns the path of a frame's picture in a golden's folder: frames/0040.png.
std::filesystem::path golden_picture(const std::filesystem::path& folder, int frame);

/// Reads manifest.json and motion.bin, and validates them completely: the result is finite, complete, and unmodified
/// since its recording.
/// @throws UsageError naming the file if one is missing, modified or of another version of drape
Golden read_golden(const std::filesystem::path& folder);

/// Reads a golden's file.
/// @param most size limit [bytes]
/// @throws UsageError naming the file if it is missing, irregular, too large or unreadable
std::string read_golden_file(const std::filesystem::path& file, std::uintmax_t most);

/// Throws an error with the file, its problem and a remedy.
/// @throws UsageError
[[noreturn]] void fail_to_read(const std::filesystem::path& file, const std::string& problem);

/// Returns true if a folder has a golden, even a damaged one; false if the folder is missing or empty.
/// @throws UsageError if writing a golden would destroy foreign data: a file, a folder of another kind, or a link in
/// the place of one of the golden's files
bool has_golden(const std::filesystem::path& folder);

/// Checks that a folder, if it exists and is not empty, holds a golden and nothing else.
/// @throws UsageError as has_golden(), and if the folder is a link or holds other files
void require_only_golden(const std::filesystem::path& folder);

/// Removes a golden's folder.
/// @throws UsageError as require_only_golden()
void remove_golden(const std::filesystem::path& folder);

/// Writes a whole golden and replaces an older one atomically. Keeps foreign files and folders in it, and permissions.
/// If the folder is a link, its target is replaced.
/// @param pictures one per frame, in order
/// @returns the size of the written files [bytes]
/// @throws UsageError as has_golden()
/// @throws OutputError
std::uintmax_t write_golden(const std::filesystem::path& folder, const Golden& golden,
                            const std::vector<Png>& pictures);

/// Returns a reason why a scene's motion cannot equal the golden one, before any step is compared.
std::optional<Difference> motion_mismatch(const Scene& scene, const Golden& golden);

/// Returns a reason why a scene's pictures cannot be compared with the golden ones.
/// @param some_frames true if only some of the golden frames are compared
std::optional<Difference> picture_mismatch(const Scene& scene, const CheckSettings& settings, const Golden& golden,
                                           bool some_frames);

/// Returns the film settings that differ from the golden ones; none for a golden without film settings.
std::vector<Difference> film_mismatch(const Scene& scene, const CheckSettings& settings, const Golden& golden);

/// Returns true if two lists of views are equal except for rounding, which may differ between processors.
bool same_but_for_rounding(const std::vector<View>& a, const std::vector<View>& b);

}  // namespace drape
