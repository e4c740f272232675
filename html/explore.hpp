#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "html/components.hpp"
#include "html/markup.hpp"

namespace drape::html {

/// Several moments of a film in one picture: as a contact sheet, without gaps.
struct Strip {
  std::string bytes;              ///< of a PNG file
  int columns = 1;                ///< pictures in a row
  int count = 1;                  ///< pictures
  std::array<int, 2> size{1, 1};  ///< of one [pixels]
  int poster = 0;                 ///< the picture that tells most
  std::string alt;                ///< what it shows, for who cannot see it
};

/// One of its pictures, or all of them, as the strips() around it say.
Markup strip(const Strip& strip);

/// Whatever has strips in it. Each shows its poster, until they show the same moment: it plays, and a slider or the
/// arrow keys choose it; or they are seen as contact sheets, as they are on paper. Without a script they show the
/// first.
/// @param moments their names, at least one: "t = 0.40 s"
Markup strips(const std::string& id, const std::vector<std::string>& moments, const Markup& content);

/// A table whose rows are put in another order by choosing a column's head.
Markup sortable_table(const Table& table);

/// Pieces of which one is seen: the one for what is chosen in each of the lists. Without a script all are seen.
struct Choices {
  std::vector<std::pair<std::string, std::vector<std::string>>> lists;  ///< their labels, and what they have
  struct Piece {
    std::vector<std::size_t> chosen;  ///< by list
    Markup content;
  };
  std::vector<Piece> pieces;  ///< the first is seen first
};
Markup choices(const std::string& id, const Choices& choices);

}  // namespace drape::html
