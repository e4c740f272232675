#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cli/film_times.hpp"
#include "run/run_scene.hpp"

namespace drape {

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
