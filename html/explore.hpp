#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "html/components.hpp"
#include "html/markup.hpp"

namespace drape::html {

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

/// Returns a table whose column heads sort its rows.
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
