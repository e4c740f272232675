#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "drape/scene/scene.hpp"
#include "run/run_scene.hpp"

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
void choose_frames(const FilmTimes& times, const LoadedScene& scene, RunOptions& options);

/// Adds --at, --from and --to.
/// @param frames the equivalent option --frames
void add_film_times(CLI::App& command, FilmTimes& times, CLI::Option* frames);

/// Arguments of render and simulate.
struct RunArguments {
  std::vector<std::string> scenes;
  std::vector<std::string> overrides;
  std::vector<std::string> outputs;
  std::string look;  ///< a scene that defines how motions are drawn
  std::string frames, every, resume, max_size, keep, sheet;
  FilmTimes times;  ///< selection of frames, in seconds
  bool poster = false;
  std::string start;  ///< first frame of looping films: first or poster
  bool open = false;  ///< open the first film after completion
  std::optional<std::int64_t> steps;
  double checkpoint_seconds = MotionOptions{}.checkpoint_seconds;
  RecordPaths records;
  GlBackend backend = GlBackend::automatic;
  std::string threads = "auto";  ///< threads per step: a number, or auto
  bool step_by_step = false;
  bool drawing = true;  ///< true for render; simulate draws nothing
};

/// Adds the options of both commands.
/// @param scenes name of the scene argument in the help
void add_shared_options(CLI::App& command, RunArguments& arguments, const char* scenes);

/// Adds --max-size and --keep.
void add_file_limit(CLI::App& command, std::string& max_size, std::string& keep);

/// Parses both; nothing if they are not given.
/// @param outputs at least one has to be a film
/// @throws UsageError
std::optional<FileLimit> parse_file_limit(const std::string& max_size, const std::string& keep,
                                          const std::vector<std::string>& outputs);

/// @throws UsageError if no output is a film
/// @param option name of the option that needs a film
void require_a_film(const std::string& option, const std::vector<std::string>& outputs);

/// Adds -o.
/// @param drawn true if outputs may need drawing
void add_outputs(CLI::App& command, RunArguments& arguments, const std::string& usage, bool drawn);

/// Returns the options for running a scene.
/// @param verbose report all details
/// @throws UsageError
RunOptions run_options(const RunArguments& arguments, const Scene& scene, bool verbose);

}  // namespace drape
