#pragma once

#include <cstddef>
#include <set>
#include <string>
#include <vector>

#include "html/markup.hpp"

namespace drape::html {

/// A moment of a film: one picture for each of its panels, as the bytes of PNG files.
struct FilmMoment {
  std::string name;  ///< "t = 0.40 s"
  std::vector<std::string> pictures;
};

/// How many moments of a film or an animation a printed page shows at most.
inline constexpr std::size_t most_printed = 4;

/// Which of `count` moments a printed page shows: evenly spread, the first and the last among them.
/// @param count at least one
std::set<std::size_t> printed_moments(std::size_t count);

/// What plays the moments of the element `id` in which it stands: a button, a slider and the moment's name.
/// @param names of the moments, at least one
/// @param more  controls behind these
Markup film_controls(const std::string& id, const std::vector<std::string>& names, const Markup& more = {});

/// Panels side by side, as far as there is room, that show the same moment: it plays, and a slider or the arrow keys
/// choose it. Without a script it shows the first, and on paper the printed_moments().
/// @param labels  of the panels
/// @param moments at least one, each with a picture for every label
Markup film(const std::string& id, const std::vector<std::string>& labels, const std::vector<FilmMoment>& moments);

}  // namespace drape::html
