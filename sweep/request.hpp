#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "drape/render/settings.hpp"
#include "drape/scene/scene.hpp"
#include "run/run_scene.hpp"

namespace drape {

/// A key of a scene and its values in a sweep.
struct Variation {
  std::string key;                  ///< "integrator.tolerance"
  std::vector<std::string> values;  ///< values as for --set
};

/// Splits a list at commas outside of brackets, braces and quotes, and expands ranges. FROM..TO/COUNT is evenly spaced
/// with both ends, FROM..TO/COUNTlog has equal ratios.
/// @throws UsageError for a malformed range
std::vector<std::string> parse_values(const std::string& text);

/// Parses a --vary argument: "key.path=value,value…".
/// @throws UsageError
Variation parse_variation(const std::string& text);

/// Returns the combinations of all keys' values. The default is their product, the last key changing fastest; `zipped`
/// combines the i-th values of all keys. Without varied keys there is one empty combination.
/// @throws UsageError if zipped keys have different numbers of values, or for more than a hundred thousand combinations
std::vector<std::vector<std::string>> combinations(const std::vector<Variation>& varied, bool zipped = false);

/// Returns a combination as overrides of a scene: "integrator.tolerance=0.01".
std::vector<std::string> overrides_of(const std::vector<Variation>& varied, const std::vector<std::string>& values);

/// Replaces --set by --vary in the lines of a message that concern these overrides of a scene or motion.
std::string as_varied(std::string_view message, const std::vector<std::string>& overrides);

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
