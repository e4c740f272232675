#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "run/run_scene.hpp"
#include "scene/scene.hpp"

namespace drape {

/// What the command line says of frames in seconds of the scene: "2.5s", "250ms".
struct FilmTimes {
  std::string at;    ///< one frame, the nearest to this time
  std::string from;  ///< the first frame that is not before it
  std::string to;    ///< the last frame that is not after it

  [[nodiscard]] bool any() const { return !at.empty() || !from.empty() || !to.empty(); }
};

/// A time in seconds.
/// @throws UsageError if the text is none
double parse_time(const std::string& option, const std::string& text);

/// Whether a text is a time and not a number: it ends in "s".
inline bool is_time(const std::string& text) { return text.ends_with('s') && text != "frames"; }

/// How many steps of h seconds a time has.
/// @throws UsageError if it has no whole number of them; it names the two nearest times that have
std::int64_t steps_in(const std::string& option, const std::string& text, double h);

/// The frames of a film that are meant.
/// @param whole all of the film's moments
/// @param film  what messages call it
/// @throws UsageError if it has no such frames
FrameRange frames_at(const FilmTimes& times, const FilmExtent& whole, const std::string& film);

/// Sets the frames of a run whose steps are known.
/// @throws UsageError if the film has no such frames
void choose_frames(const FilmTimes& times, const Scene& scene, RunOptions& options);

/// Adds --at, --from and --to.
/// @param frames the option --frames, which says the same in numbers
void add_film_times(CLI::App& command, FilmTimes& times, CLI::Option* frames);

}  // namespace drape
