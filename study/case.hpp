#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace drape {

/// A scene with a few values replaced, run for a number of steps: what a study measures.
struct StudyCase {
  std::string label;                   ///< "liu13, ε = 1e-3"
  std::string scene;                   ///< below the data folder: "scenes/homework/3.toml"
  std::vector<std::string> overrides;  ///< as for --set
  std::int64_t steps = 0;

  /// @throws UsageError
  [[nodiscard]] Scene load() const;

  /// The command that runs this case, and no other.
  [[nodiscard]] std::string command() const;
};

}  // namespace drape
