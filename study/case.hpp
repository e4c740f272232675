#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace drape {

/// A scene with a few overrides and a number of steps: the unit of measurement of a study.
struct StudyCase {
  std::string label;                   ///< a file, relative to `folder`: "scenes/homework/3.toml"
  std::string scene;                   ///< a file, relative to `folder`: "scenes/homework/3.toml"
  std::vector<std::string> overrides;  ///< overrides as for --set
  std::int64_t steps = 0;
  std::int64_t watched_steps = 0;     ///< steps of the untimed run, if more than `steps`
  std::filesystem::path folder = {};  ///< empty: the data folder
  /// Computing time limit for `steps` [s]; absent: no limit, and a divergence is an error.
  std::optional<double> patience = {};

  /// @throws UsageError
  [[nodiscard]] Scene load() const;

  /// Returns the command that runs this case.
  [[nodiscard]] std::string command() const;
  /// Returns the command that makes a film of this case.
  /// @param film name of the film
  [[nodiscard]] std::string film_command(const std::string& film) const;
};

/// Formats a number for a command line: the shortest text that reads back exactly.
std::string plain_number(double value);

}  // namespace drape
