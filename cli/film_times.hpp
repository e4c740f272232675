#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "run/run_scene.hpp"
#include "scene/scene.hpp"

namespace drape {

/// Selection of frames by scene time: "2.5s", "250ms".
struct FilmTimes {
  std::string at;    ///< one frame, nearest to this time
  std::string from;  ///< first frame at or after this time
  std::string to;    ///< last frame at or before this time

  [[nodiscard]] bool any() const { return !at.empty() || !from.empty() || !to.empty(); }
};

/// Parses a time and returns seconds.
/// @throws UsageError if the text is not a time
double parse_time(const std::string& option, const std::string& text);

/// Returns true for a time rather than a number: the text ends in "s".
inline bool is_time(const std::string& text) { return text.ends_with('s') && text != "frames"; }

/// Returns a time as a number of steps of h seconds.
/// @throws UsageError if it is not a multiple of h, with the two nearest multiples
std::int64_t steps_in(const std::string& option, const std::string& text, double h);

/// Returns the selected frames of a film.
/// @param whole range of the whole film
/// @param film  name of the film for messages
/// @throws UsageError if there are no such frames
FrameRange frames_at(const FilmTimes& times, const FilmExtent& whole, const std::string& film);

/// Sets the frames of a run with a known number of steps.
/// @throws UsageError if the film has no such frames
void choose_frames(const FilmTimes& times, const Scene& scene, RunOptions& options);

/// Adds --at, --from and --to.
/// @param frames the equivalent option --frames
void add_film_times(CLI::App& command, FilmTimes& times, CLI::Option* frames);

}  // namespace drape
