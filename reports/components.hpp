#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "reports/page.hpp"

namespace drape::html {

/// Kind of a statement, shown by a word and a sign besides the colour.
enum class Tone { neutral, good, caution, bad };

/// Returns a word in the colour of its tone, with its sign.
Markup badge(const std::string& word, Tone tone);

/// Returns a section with a heading and an anchor. @param level level of the heading: 2 or 3
Markup section(int level, const std::string& id, const Markup& heading, const Markup& content);

Markup paragraph(const Markup& content);
/// Returns a less important remark.
Markup note(const Markup& content);
Markup code(const std::string& text);
Markup link(const std::string& href, const Markup& content);

/// Returns a command with a copy button, under a label that describes it.
Markup command(const std::string& label, const std::string& line);

/// Returns a menu that copies the enclosing diagram ("SVG", "PNG") or its table ("CSV", "Markdown", "LaTeX").
/// @param of description of the copied object for screen readers
Markup copies(const std::vector<std::string>& forms, const std::string& of);

struct Finding {
  Tone tone = Tone::neutral;
  Markup text;
};
/// Returns a list of findings, most important first.
Markup findings(const std::vector<Finding>& list);

struct Column {
  Markup title;
  bool numeric = false;  ///< right-aligned, in figures of equal width
};
struct Table {
  std::string caption;  ///< description, also for screen readers
  std::vector<Column> columns;
  std::vector<std::vector<Markup>> rows;
  bool copied = true;  ///< has a menu to copy it; false: an enclosing diagram's menu does
};
/// Returns a table with a menu to copy it. A table too wide for a phone becomes cards there: one for each row, in which
/// the columns' titles label the cells. In a wider window it scrolls sideways if necessary.
Markup table(const Table& table);

/// Returns a list of names and values.
Markup facts(const std::vector<std::pair<std::string, Markup>>& list);

/// Returns a collapsible block.
Markup details(const Markup& summary, const Markup& content, bool open = false);

/// Returns an embedded picture.
/// @param type  "image/png", "image/gif"
/// @param bytes content of the file
/// @param alt   description for screen readers
Markup picture(const std::string& type, const std::string& bytes, const std::string& alt);

/// Returns an animation; in print some of its frames instead.
/// @param gif    bytes of the GIF file
/// @param stills PNG file with frames side by side; empty: the first frame is printed
Markup animation(const std::string& gif, const std::string& stills, const std::string& alt);

/// Returns a picture or similar content with a caption.
Markup figure(const Markup& content, const Markup& caption);

/// Returns pieces side by side, wrapped to the width.
Markup row(const std::vector<Markup>& pieces);

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
