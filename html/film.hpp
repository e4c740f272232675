#pragma once

#include <cstddef>
#include <set>
#include <string>
#include <vector>

#include "html/markup.hpp"

namespace drape::html {

/// A moment of a film: one picture for each panel, as bytes of PNG files.
struct FilmMoment {
  std::string name;  ///< "t = 0.40 s"
  std::vector<std::string> pictures;
};

/// Most moments of a film or an animation on a printed page.
inline constexpr std::size_t most_printed = 4;

/// Returns the moments out of `count` that a printed page shows: evenly spread, including the first and the last.
/// @param count at least one
std::set<std::size_t> printed_moments(std::size_t count);

/// Returns the controls of the enclosing element `id`: a play button, a slider and the moment's name.
/// @param names names of the moments, at least one
/// @param first index of the moment shown before one is chosen
/// @param more  further controls
Markup film_controls(const std::string& id, const std::vector<std::string>& names, std::size_t first = 0,
                     const Markup& more = {});

/// Returns panels side by side (wrapped to the width) that show the same moment, chosen by playing, a slider or the
/// arrow keys. Until then they show the poster, in print the printed_moments().
/// @param labels  labels of the panels
/// @param moments at least one, each with a picture for every label
/// @param poster  index of the most telling moment
Markup film(const std::string& id, const std::vector<std::string>& labels, const std::vector<FilmMoment>& moments,
            std::size_t poster = 0);

}  // namespace drape::html
