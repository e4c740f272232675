#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "html/components.hpp"

namespace drape::html {

/// Two pictures that should be the same, as the bytes of PNG files; those that are empty do not exist.
struct ComparedPictures {
  std::string name;  ///< "frame 40"
  Tone tone = Tone::neutral;
  std::string expected, actual, difference, error_map;
  Markup caption;                           ///< in words: what differs
  Markup action;                            ///< below the pictures: what can be done about it
  std::array<int, 2> size{1, 1};            ///< [pixels]
  std::vector<std::array<int, 4>> ignored;  ///< parts that are not judged, hatched: left, top, width, height [pixels]
  std::optional<std::array<int, 2>> worst;  ///< the pixel to look at: column and row, from the top left
};

/// A viewer for pictures of several moments: choose the moment, and see the pictures side by side, under a slider,
/// blinking, or their difference and error map alone; a magnifier shows the worst pixel. Everything has its key.
/// @param id    of its own in the page
/// @param shown index of the moment that is shown first
Markup comparison(const std::string& id, const std::vector<ComparedPictures>& moments, std::size_t shown = 0);

}  // namespace drape::html
