#pragma once

#include <array>
#include <cstddef>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "reports/components.hpp"
#include "reports/page.hpp"

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

/// A motion for playback in a page, see output/html_writer.hpp and motion_data.js.
struct PlayedMotion {
  std::string description;  ///< JSON: sizes, times, colours
  std::string data;         ///< numbers of the motion, a zlib stream
  std::string texture;      ///< texture of the cloth, a PNG file; empty: none
  int frames = 0;
  double precision = 0;  ///< unit of the coordinates [m]
  double size = 0;       ///< diagonal of the motion's bounding box [m]
  std::size_t vertices = 0, triangles = 0;
};

/// Returns an interactive WebGL view of a motion: it can be turned, played, and coloured by its stretch. It shows the
/// poster frame until a moment is chosen, and plays from the start. Without WebGL 2 or scripts a sentence replaces it.
/// @param label name of the canvas for screen readers: "The cloth of scene 5"
Markup motion_player(const std::string& id, const PlayedMotion& motion, const std::string& label);

/// Describes a motion's size and precision in a sentence.
std::string describe(const PlayedMotion& motion);

/// Several moments of a film in one picture: a contact sheet without gaps.
struct Strip {
  std::string bytes;              ///< content of a PNG file
  int columns = 1;                ///< pictures per row
  int count = 1;                  ///< number of pictures
  std::array<int, 2> size{1, 1};  ///< size of one picture [pixels]
  int poster = 0;                 ///< index of the most informative picture
  std::string alt;                ///< description for screen readers
};

/// Returns one of the pictures or all of them, controlled by the enclosing strips().
Markup strip(const Strip& strip);

/// Wraps content with strips. Each shows its poster until a common moment is chosen by playing, a slider or the arrow
/// keys. Alternatively, and in print, they are contact sheets. Without scripts they show the first moment.
/// @param moments their names, at least one: "t = 0.40 s"
Markup strips(const std::string& id, const std::vector<std::string>& moments, const Markup& content);

/// Returns a table whose column heads sort its rows. A long one has a field that filters them.
Markup sortable_table(const Table& table);

/// Pieces of which one is visible, selected by several lists. Without scripts all are visible.
struct Choices {
  std::vector<std::pair<std::string, std::vector<std::string>>> lists;  ///< label and items of each list
  struct Piece {
    std::vector<std::size_t> chosen;  ///< selected item of each list
    Markup content;
  };
  std::vector<Piece> pieces;  ///< the first is visible initially
};
Markup choices(const std::string& id, const Choices& choices);

}  // namespace drape::html
