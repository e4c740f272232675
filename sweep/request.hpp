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

/// What a sweep is asked to do.
struct SweepRequest {
  std::vector<std::string> scenes;     ///< files
  std::vector<std::string> overrides;  ///< of every run, before its values
  std::vector<Variation> varied;
  bool zipped = false;                ///< the values go in pairs, instead of every one with every other
  std::vector<std::string> films;     ///< extensions of what is made of every run: "gif"
  bool motion = false;                ///< keep every run's motion
  std::optional<std::int64_t> steps;  ///< instead of the scenes' durations
  GlBackend backend = GlBackend::automatic;
};

/// Adds what the table [sweep] of a file says, if it has one; what the request says already stays. A file that names
/// `scenes` in it is no scene itself: they take its place, from its folder.
/// @param file one of the request's scenes
/// @returns the scenes in its place
/// @throws UsageError with all that is wrong with the table
std::vector<std::string> add_sweep_table(const std::string& file, SweepRequest& request);

/// The shell's command that asks for it again, without where it is written to.
std::string command_of(const SweepRequest& request);

/// What a run of it writes into a folder.
RunOptions run_options(const SweepRequest& request, const std::filesystem::path& folder);

/// How many moments the contact sheets of films have, and how they stand.
inline constexpr SheetGrid sweep_sheet{.columns = 4, .rows = 3, .labelled = false};

}  // namespace drape
