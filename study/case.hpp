#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace drape {

/// A scene with a few values replaced, run for a number of steps: what a study measures.
struct StudyCase {
  std::string label;                   ///< "liu13, ε = 1e-3"
  std::string scene;                   ///< a file, relative to `folder`: "scenes/homework/3.toml"
  std::vector<std::string> overrides;  ///< as for --set
  std::int64_t steps = 0;
  std::int64_t watched_steps = 0;     ///< of a run that is not timed, if they are more than `steps`
  std::filesystem::path folder = {};  ///< empty: the data folder
  /// Computing time of a run of `steps` from which on it is given up [s]; absent: never, and it must not diverge
  /// either.
  std::optional<double> patience = {};

  /// @throws UsageError
  [[nodiscard]] Scene load() const;

  /// The command that runs this case, and no other.
  [[nodiscard]] std::string command() const;
  /// The command that makes a film of it.
  /// @param film its name
  [[nodiscard]] std::string film_command(const std::string& film) const;
};

/// A number as it is written on a command line: the shortest that reads back as the same.
std::string plain_number(double value);

}  // namespace drape
