#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "render/backend.hpp"
#include "run/run_scene.hpp"
#include "scene/scene.hpp"
#include "sweep/variation.hpp"

namespace drape {

/// The user's request for a sweep.
struct SweepRequest {
  std::vector<std::string> scenes;     ///< scene files
  std::vector<std::string> overrides;  ///< overrides of every run, before its varied values
  std::vector<Variation> varied;
  bool zipped = false;                ///< combine the i-th values of all keys, not every value with every other
  std::vector<std::string> films;     ///< file extensions of the films to make of every run: "gif"
  bool motion = false;                ///< keep every run's motion
  std::optional<std::int64_t> steps;  ///< instead of the scenes' durations
  GlBackend backend = GlBackend::automatic;
};

/// Adds the [sweep] table of a file to the request; existing settings take precedence. A file with `scenes` in this
/// table is no scene itself: the listed scenes, relative to its folder, replace it.
/// @param file one of the request's scenes
/// @returns the scenes that replace it
/// @throws UsageError with all errors in the table
std::vector<std::string> add_sweep_table(const std::string& file, SweepRequest& request);

/// Returns the shell command for the request, without its output folder.
std::string command_of(const SweepRequest& request);

/// Returns the options of a run that writes into a folder.
RunOptions run_options(const SweepRequest& request, const std::filesystem::path& folder);

/// Layout of the films' contact sheets.
inline constexpr SheetGrid sweep_sheet{.columns = 4, .rows = 3, .labelled = false};

}  // namespace drape
