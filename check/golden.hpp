#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "check/report.hpp"
#include "check/rounding.hpp"
#include "render/image.hpp"
#include "render/settings.hpp"
#include "render/view.hpp"
#include "sim/simulation.hpp"

namespace drape {

/// What a step of the golden motion ended in.
struct GoldenStep {
  std::uint32_t hash = 0;      ///< of every bit, see step_hash()
  std::vector<double> bodies;  ///< what moves the cloth and where it is, see body_numbers(), to Quanta::compared
};

/// A piece of the golden motion: a state and the steps from there on. It ends where the next one begins, but for the
/// rounding of that.
struct GoldenWindow {
  State start;                    ///< rounded as Quanta says; that of the first one as the simulation makes it
  std::vector<GoldenStep> steps;  ///< after start.step + 1, + 2, …; none in the last window, which is the motion's end
  Vertices middle;                ///< positions after half of the steps, to Quanta::compared; empty below two steps [m]
  Energies energies;              ///< where it ends [J]

  [[nodiscard]] std::int64_t last_step() const { return start.step + static_cast<std::int64_t>(steps.size()); }
  [[nodiscard]] std::int64_t middle_step() const { return start.step + static_cast<std::int64_t>(steps.size() / 2); }
};

/// A frame of the film whose picture is compared.
struct GoldenFrame {
  int frame = 0;            ///< its number
  double time = 0;          ///< of the scene [s]
  std::string why;          ///< it was chosen: "first contact with the sphere"
  View view = {};           ///< where the camera stood: the whole motion need not be run to know
  Vertices x;               ///< positions that the picture shows, rounded as Quanta says [m]
  std::string pixels = {};  ///< hash of the picture, see pixel_hash(); set when it is written
};

/// Values of a film that pictures of some frames, in a size of their own, need not show.
struct GoldenFilm {
  double fps = 25;
  double speed = 1;            ///< seconds of the scene per second of the film
  Eigen::Vector2i size{0, 0};  ///< [pixels]
  int samples = 4;             ///< per pixel
};

/// The method that was chosen where a scene names none.
struct GoldenMethod {
  Method method = Method::quasi_newton;  ///< what every scene had that named none, before one was chosen
  std::optional<int> substeps;           ///< of a step by an explicit method
};

/// Time of the first steps.
struct GoldenTime {
  std::int64_t steps = 0;
  double ratio = 0;  ///< to the calibration loop, see measure_step_time()
};

/// Everything that a scene is compared with.
struct Golden {
  std::string scene_digest;  ///< Scene::digest
  std::string date;          ///< "2026-01-31T12:00:00Z"
  Machine machine;
  Eigen::Vector2i size{0, 0};   ///< of the pictures [pixels]
  double step = 0;              ///< h [s]
  std::int64_t step_count = 0;  ///< of the whole motion
  std::int64_t window_steps = 1;
  int vertex_count = 0;
  int row = 1;         ///< how far apart the numbers of vertices are that lie side by side, where rows of a grid do
  int body_count = 0;  ///< of GoldenStep::bodies, at most
  double seconds_per_frame = 0;        ///< of the scene's time
  std::optional<GoldenFilm> film;      ///< absent where an older drape has recorded it
  std::optional<GoldenMethod> method;  ///< absent where the scene names one
  std::optional<GoldenTime> time;      ///< absent unless the scene's [check] had a `time`
  Quanta quanta;
  Camera camera;                      ///< what the scene said
  std::vector<View> frames_views;     ///< where it would stand if the compared frames were the whole motion
  std::vector<GoldenWindow> windows;  ///< they tile the motion; the last one is its end
  std::vector<GoldenFrame> frames;    ///< ascending
};

/// Whether two cameras are the same to the last bit.
bool same_camera(const Camera& a, const Camera& b);

/// A short hash of every bit of a simulation's positions and velocities, of where everything is that the cloth can
/// touch, and of which vertices are pinned.
std::uint32_t step_hash(const Simulation& simulation);

/// Where everything is that the cloth can touch, and where its pins are (of many some, spread over them): numbers of
/// which each may be as far from the golden one as a vertex.
std::vector<double> body_numbers(const Simulation& simulation);

/// "sphere", "ground".
const char* body_kind(const Collider& collider);

/// What body_numbers()[index] belongs to: "sphere 1", "ground 2", "pin 20".
std::string body_name(const Simulation& simulation, std::size_t index);

/// A hash of a picture's pixels, as 16 hexadecimal digits: the same however the PNG file packs them.
std::string pixel_hash(const Image& picture);

/// Where a motion of so many steps is cut: the first steps of its windows, and its last one.
std::vector<std::int64_t> window_starts(std::int64_t step_count, std::int64_t window_steps);

/// Those of a golden's frames that are wanted; empty: all.
/// @param folder of the golden, for the message
/// @throws UsageError if it has no such frame
std::vector<GoldenFrame> chosen_frames(const Golden& golden, const std::vector<int>& wanted,
                                       const std::filesystem::path& folder);

/// The folder of a scene's golden, beside it: scenes/5.golden for scenes/5.toml.
std::filesystem::path golden_folder(const std::filesystem::path& scene_file);

/// The golden picture of a frame in such a folder: frames/0040.png.
std::filesystem::path golden_picture(const std::filesystem::path& folder, int frame);

/// Reads manifest.json and motion.bin, of which nothing is trusted: what comes back is finite, complete, and what was
/// written.
/// @throws UsageError naming the file if one is missing, is not as it was recorded, or of another version of drape
Golden read_golden(const std::filesystem::path& folder);

}  // namespace drape
