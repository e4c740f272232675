#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cli/film_times.hpp"
#include "run/run_scene.hpp"

namespace drape {

/// What render and simulate share.
struct RunArguments {
  std::vector<std::string> scenes;
  std::vector<std::string> overrides;
  std::vector<std::string> outputs;
  std::string look;  ///< a scene that says how motions are drawn
  std::string frames, every, resume, max_size, keep, sheet;
  FilmTimes times;  ///< as frames, in seconds
  bool poster = false;
  std::string start;  ///< of films that repeat for ever: first or poster
  bool open = false;  ///< show the first film when it is complete
  std::optional<std::int64_t> steps;
  double checkpoint_seconds = MotionOptions{}.checkpoint_seconds;
  RecordPaths records;
  GlBackend backend = GlBackend::automatic;
  std::string threads = "auto";  ///< that share a step: a number, or auto
  bool step_by_step = false;
  bool drawing = true;  ///< render; simulate draws nothing
};

/// Adds the options that both have.
/// @param scenes what may stand as a scene
void add_shared_options(CLI::App& command, RunArguments& arguments, const char* scenes);

/// Adds --max-size and --keep.
void add_file_limit(CLI::App& command, std::string& max_size, std::string& keep);

/// What the two say; nothing where they are not given.
/// @param outputs at least one of which has to be a film
/// @throws UsageError
std::optional<FileLimit> parse_file_limit(const std::string& max_size, const std::string& keep,
                                          const std::vector<std::string>& outputs);

/// @throws UsageError if no output is a film
/// @param option that is for films
void require_a_film(const std::string& option, const std::vector<std::string>& outputs);

/// Adds -o.
/// @param drawn whether what must be drawn may be among them
void add_outputs(CLI::App& command, RunArguments& arguments, const std::string& usage, bool drawn);

/// What a run of a scene should do.
/// @param verbose whether everything about it is shown
/// @throws UsageError
RunOptions run_options(const RunArguments& arguments, const Scene& scene, bool verbose);

}  // namespace drape
