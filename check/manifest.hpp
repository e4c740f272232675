#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "check/golden.hpp"

namespace drape {

/// What manifest.json says about a window of motion: in a form that a reviewer can compare, and enough to see whether
/// the motion.bin beside it is the one that was recorded with it.
struct WindowSummary {
  std::optional<int> frame;  ///< as GoldenWindow
  double time = 0;           ///< of the frame [s]
  std::int64_t first_step = 0, last_step = 0;
  std::optional<std::array<double, 3>> energies;  ///< kinetic, gravity, elastic, after the last step [J]; absent: none

  bool operator==(const WindowSummary&) const = default;
};

WindowSummary summary_of(const GoldenWindow& window);

/// manifest.json, read.
struct Manifest {
  Golden golden;  ///< all but its windows
  std::vector<WindowSummary> windows;
};

/// The bytes of manifest.json.
std::string manifest_text(const Golden& golden);

/// The inverse. Every value is there, of its type and in a range that makes sense.
/// @throws std::invalid_argument saying what is wrong with the bytes
Manifest read_manifest(std::string_view bytes);

}  // namespace drape
