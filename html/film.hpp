#pragma once

#include <string>
#include <vector>

#include "html/markup.hpp"

namespace drape::html {

/// A moment of a film: one picture for each of its panels, as the bytes of PNG files.
struct FilmMoment {
  std::string name;  ///< "t = 0.40 s"
  std::vector<std::string> pictures;
};

/// Panels side by side, as far as there is room, that show the same moment: it plays, and a slider or the arrow keys
/// choose it. Without a script it shows the first.
/// @param labels  of the panels
/// @param moments at least one, each with a picture for every label
Markup film(const std::string& id, const std::vector<std::string>& labels, const std::vector<FilmMoment>& moments);

}  // namespace drape::html
