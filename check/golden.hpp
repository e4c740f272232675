#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "check/report.hpp"
#include "render/settings.hpp"
#include "render/view.hpp"
#include "sim/simulation.hpp"

namespace drape {

/// What a step of the golden motion ended in.
struct GoldenStep {
  std::uint64_t bits = 0;  ///< hash of the state, see state_bits()
  Vertices x;              ///< rounded to the golden's quantum [m]
  Energies energies;       ///< [J]
};

/// A piece of the golden motion: an exact state and the steps from there on.
struct GoldenWindow {
  std::optional<int> frame;       ///< the compared frame that the picture shows; absent: it has no picture
  double time = 0;                ///< of the frame [s]
  State start;                    ///< exact, at or just before the frame
  std::optional<Vertices> shown;  ///< the exact positions in the picture, where the frame falls between two steps
  std::vector<GoldenStep> steps;  ///< after start.step + 1, + 2, …

  [[nodiscard]] const Vertices& picture_positions() const { return shown ? *shown : start.x; }
};

/// The finest rounding of positions, where the bits are to be the same [m].
constexpr double least_quantum = 1e-10;

/// Everything that a scene is compared with.
struct Golden {
  std::string scene_digest;  ///< Scene::digest
  std::string date;          ///< "2026-01-31T12:00:00Z"
  Machine machine;
  Eigen::Vector2i size{0, 0};   ///< of the pictures [pixels]
  double step = 0;              ///< h [s]
  std::int64_t step_count = 0;  ///< of the whole motion
  int vertex_count = 0;
  double seconds_per_frame = 0;       ///< of the scene's time
  double quantum = 1e-7;              ///< of GoldenStep::x, at least least_quantum [m]
  Camera camera;                      ///< what the scene said
  View view;                          ///< and where it stood: the whole motion need not be run to know
  View window_view;                   ///< where it would stand if the windows' starts were the whole motion
  std::vector<GoldenWindow> windows;  ///< ascending
};

/// Whether two cameras are the same to the last bit.
bool same_camera(const Camera& a, const Camera& b);

/// A hash of all bits of a state's positions and velocities.
std::uint64_t state_bits(const State& state);

/// The folder of a scene's golden, beside it: scenes/5.golden for scenes/5.toml.
std::filesystem::path golden_folder(const std::filesystem::path& scene_file);

/// The golden picture of a frame in such a folder: frames/0040.png.
std::filesystem::path golden_picture(const std::filesystem::path& folder, int frame);

/// Reads manifest.json and motion.bin, of which nothing is trusted: what comes back is finite, complete, and
/// consistent.
/// @throws UsageError naming the file if one is missing, damaged, or of a newer version of drape
Golden read_golden(const std::filesystem::path& folder);

}  // namespace drape
