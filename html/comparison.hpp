#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "html/components.hpp"

namespace drape::html {

/// Two pictures that should be equal, as bytes of PNG files; empty: missing.
struct ComparedPictures {
  std::string name;  ///< "frame 40"
  Tone tone = Tone::neutral;
  std::string expected, actual, difference, error_map;
  Markup caption;                           ///< description of the differences
  Markup action;                            ///< actions for this result, below the pictures
  std::array<int, 2> size{1, 1};            ///< [pixels]
  std::vector<std::array<int, 4>> ignored;  ///< excluded areas, hatched: left, top, width, height [pixels]
  std::optional<std::array<int, 2>> worst;  ///< pixel with the largest error: column and row, from the top left
};

/// Returns a viewer for pictures of several moments. For each, it shows the pictures side by side, under a slider or
/// blinking, or their difference and error map; a magnifier shows the worst pixel. Every function has a key.
/// @param id    unique in the page
/// @param shown index of the initial moment
Markup comparison(const std::string& id, const std::vector<ComparedPictures>& moments, std::size_t shown = 0);

}  // namespace drape::html
