#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "drape/scene/scene.hpp"
#include "output/registry.hpp"
#include "reports/diagram.hpp"
#include "run/frame_source.hpp"
#include "run/run_scene.hpp"
#include "scene/values.hpp"

namespace drape {

/// Parses "5MB", "800 kB", "1.5GiB" or "5000" as bytes: k, M, G are powers of 1000; ki, Mi, Gi of 1024.
/// @param option option name for messages
/// @throws UsageError if it is anything else, or less than one byte
std::uint64_t parse_byte_count(const std::string& option, const std::string& text);

/// Parses "0,40,80" to ascending numbers; nothing for an empty text.
/// @throws UsageError for other texts
std::vector<int> parse_frame_list(const std::string& text);

/// Parses a range of frames "A..B".
/// @throws UsageError for other texts
FrameRange parse_frames(const std::string& text);

/// Parses "4x3", columns and rows.
/// @param option option name for messages
/// @throws UsageError for other texts, or more than 100 columns or rows
SheetGrid parse_grid(const std::string& option, const std::string& text);

/// Help of --sheet.
inline constexpr const char* sheet_help =
    "COLUMNSxROWS: a .png without {frame} shows so many moments of the film, evenly spread, instead of the last";

/// Parses the value of --sheet; nothing if it is empty.
/// @throws UsageError if the text is not a grid, or no output is a .png without {frame}
std::optional<SheetGrid> parse_sheet(const std::string& text, const std::vector<std::string>& outputs);

/// Accepts a text without line feeds and other control characters: a name for scripts and messages.
CLI::Validator on_one_line();

/// Accepts a finite number in the range.
CLI::Validator number_in(const Range& range);

/// Accepts a whole number in the range.
CLI::Validator whole_number_in(const Range& range);

/// Adds --quality, a short form of --set look.quality=….
/// @param overrides receives the value; must outlive the command
void add_quality_option(CLI::App& command, std::vector<std::string>& overrides);

/// Adds --style, shared by all subcommands that write diagrams as files.
void add_style_option(CLI::App& subcommand, FigureStyle& style);

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

/// Returns true if the text is a time: it ends in "s" and is not "frames".
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
  std::string look;                                          ///< a scene that defines how motions are drawn
  std::string frames, every, resume, max_size, keep, sheet;  ///< values of the options of these names
  FilmTimes times;                                           ///< selection of frames, in seconds
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

/// Adds the options shared by render and simulate.
/// @param scenes name of the scene argument in the help
void add_shared_options(CLI::App& command, RunArguments& arguments, const char* scenes);

/// Adds --max-size and --keep.
void add_file_limit(CLI::App& command, std::string& max_size, std::string& keep);

/// Parses --max-size and --keep. Returns nothing if they are not given.
/// @param outputs at least one has to be a film
/// @throws UsageError
std::optional<FileLimit> parse_file_limit(const std::string& max_size, const std::string& keep,
                                          const std::vector<std::string>& outputs);

/// Checks that at least one output is a film.
/// @param option name of the option that needs a film
/// @throws UsageError if no output is a film
void require_a_film(const std::string& option, const std::vector<std::string>& outputs);

/// Adds -o.
/// @param drawn true if outputs may need drawing
void add_outputs(CLI::App& command, RunArguments& arguments, const std::string& usage, bool drawn);

/// Returns the options for running a scene.
/// @param verbose report all details
/// @throws UsageError
RunOptions run_options(const RunArguments& arguments, const Scene& scene, bool verbose);

}  // namespace drape
