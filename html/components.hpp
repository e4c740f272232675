#pragma once

#include <string>
#include <utility>
#include <vector>

#include "html/markup.hpp"

namespace drape::html {

/// How something stands, which is said by a word and a sign as well as by a colour.
enum class Tone { neutral, good, caution, bad };

/// A word in the colour of its tone, with its sign.
Markup badge(const std::string& word, Tone tone);

/// A section with a heading and an anchor. @param level of the heading: 2 or 3
Markup section(int level, const std::string& id, const Markup& heading, const Markup& content);

Markup paragraph(const Markup& content);
/// A less important remark.
Markup note(const Markup& content);
Markup code(const std::string& text);
Markup link(const std::string& href, const Markup& content);

/// A command that can be copied, under a label that says what it does.
Markup command(const std::string& label, const std::string& line);

/// Buttons that copy the table, or the diagram ("SVG", "PNG"), in which they stand.
/// @param of what is copied, for who cannot see it
Markup copies(const std::vector<std::string>& forms, const std::string& of);

struct Finding {
  Tone tone = Tone::neutral;
  Markup text;
};
/// What came out, most important first.
Markup findings(const std::vector<Finding>& list);

struct Column {
  Markup title;
  bool numeric = false;  ///< set to the right, in figures of equal width
};
struct Table {
  std::string caption;  ///< what it shows, for everybody
  std::vector<Column> columns;
  std::vector<std::vector<Markup>> rows;
  /// What each cell is called in a narrow window, where a row is a card: the columns; empty: the table stays one.
  std::vector<std::string> card_labels = {};
};
/// A table that scrolls sideways where it does not fit, and can be copied for LaTeX, Markdown and spreadsheets.
Markup table(const Table& table);

/// Names and their values.
Markup facts(const std::vector<std::pair<std::string, Markup>>& list);

/// Something that opens when its summary is chosen.
Markup details(const Markup& summary, const Markup& content, bool open = false);

/// A picture that is part of the page.
/// @param type  "image/png", "image/gif"
/// @param bytes of the file
/// @param alt   what it shows, for who cannot see it
Markup picture(const std::string& type, const std::string& bytes, const std::string& alt);

/// An animation, and on paper some of its moments instead.
/// @param gif    bytes of the GIF file
/// @param stills of a PNG file that shows the moments side by side; empty: the animation's first picture is printed
Markup animation(const std::string& gif, const std::string& stills, const std::string& alt);

/// A picture, or something like it, with a line below.
Markup figure(const Markup& content, const Markup& caption);

/// Pieces side by side as far as there is room.
Markup row(const std::vector<Markup>& pieces);

}  // namespace drape::html
