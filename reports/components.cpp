#include "reports/components.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <sstream>
#include <stdexcept>

#include "reports/diagram.hpp"

namespace drape::html {
namespace {

constexpr std::size_t narrow = 9;  // most columns that fit on paper at the usual size

std::string tone_class(Tone tone) {
  switch (tone) {
    case Tone::neutral:
      return "neutral";
    case Tone::good:
      return "good";
    case Tone::caution:
      return "caution";
    case Tone::bad:
      return "bad";
  }
  return "";
}

/// Returns the width of a table's columns, each as wide as its widest cell.
/// @param space between two columns
template <class Width>
double width_of(const Table& table, double space, Width width) {
  double total = 0;
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    double widest = width(table.columns[c].title);
    for (const std::vector<Markup>& cells : table.rows)
      widest = std::max(widest, c < cells.size() ? width(cells[c]) : 0);
    total += widest + space;
  }
  return total;
}

/// Estimates whether a table fits a window of 390 pixels.
bool fits_phone(const Table& table) {
  constexpr double room = 350, letter = 8, space = 22, figure = 192;  // [pixels]
  return width_of(table, space, [](const Markup& cell) {
           return cell.html().find("<img") == std::string::npos ? letter * letters(plain_text(cell)) : figure;
         }) <= room;
}

/// Estimates whether a table fits A4 in small letters, with lines broken between words only.
bool fits_paper(const Table& table) {
  constexpr double room = 688, letter = 5.2, space = 5;  // [pixels]
  return width_of(table, space, [](const Markup& cell) {
           double longest = 0;
           std::istringstream words(plain_text(cell));
           for (std::string word; words >> word;) longest = std::max(longest, letter * letters(word));
           return longest;
         }) <= room;
}

}  // namespace

Markup badge(const std::string& word, Tone tone) {
  return element("span", {{"class", "badge " + tone_class(tone)}}, word);
}

Markup section(int level, const std::string& id, const Markup& heading, const Markup& content) {
  const std::string tag = level == 2 ? "h2" : "h3";
  return element("section", {{"aria-labelledby", id}}, element(tag, {{"id", id}}, heading) + content);
}

Markup paragraph(const Markup& content) { return element("p", content); }
Markup note(const Markup& content) { return element("p", {{"class", "note"}}, content); }
Markup code(const std::string& text) { return element("code", text); }
Markup link(const std::string& href, const Markup& content) { return element("a", {{"href", href}}, content); }

Markup command(const std::string& label, const std::string& line) {
  return element(
      "div", {{"class", "command"}},
      element("span", {{"class", "label"}}, label) + element("code", {{"tabindex", "0"}}, line) +
          element("button", {{"type", "button"}, {"class", "copy"}, {"aria-label", "Copy: " + label}}, "Copy"));
}

Markup findings(const std::vector<Finding>& list) {
  Markup items;
  for (const Finding& finding : list) items += element("li", {{"class", tone_class(finding.tone)}}, finding.text);
  return element("ul", {{"class", "findings"}}, items);
}

Markup copies(const std::vector<std::string>& forms, const std::string& of) {
  Markup buttons;
  for (const std::string& form : forms) {
    const std::string says = "Copy as " + form + ": " + of;
    buttons += element("button", {{"type", "button"}, {"data-form", form}, {"aria-label", says}}, form);
  }
  return element(
      "details", {{"class", "copies"}},
      element("summary", {{"aria-label", "Copy: " + of}}, "Copy as") + element("div", {{"class", "forms"}}, buttons));
}

Markup table(const Table& table) {
  const auto cell = [&](std::string_view tag, std::size_t column, const Markup& content) {
    Attributes attributes;
    std::string style = table.columns[column].numeric ? "number" : "";
    if (tag == "th") attributes.push_back({"scope", "col"});
    if (tag == "td" && content.html() == "–") style += style.empty() ? "none" : " none";  // a card leaves it out
    if (!style.empty()) attributes.push_back({"class", style});
    if (tag == "td") attributes.push_back({"data-column", plain_text(table.columns[column].title)});
    // A card's grid takes the content as one item.
    const bool several = tag == "td" && content.html().find('<') != std::string::npos;
    return element(tag, attributes, several ? element("div", content) : content);
  };
  std::string style = table.columns.size() <= narrow ? "" : fits_paper(table) ? "wide" : "wide crowded";
  if (!fits_phone(table)) style += style.empty() ? "cards" : " cards";
  Markup head, body;
  for (std::size_t c = 0; c < table.columns.size(); ++c) head += cell("th", c, table.columns[c].title);
  for (const std::vector<Markup>& cells : table.rows) {
    if (cells.size() != table.columns.size()) throw std::invalid_argument("a row must have a cell for every column");
    Markup line;
    for (std::size_t c = 0; c < cells.size(); ++c) line += cell("td", c, cells[c]);
    body += element("tr", line);
  }
  const Markup menu = table.copied ? copies({"CSV", "Markdown", "LaTeX"}, table.caption) : Markup();
  const Markup content =
      element("table", style.empty() ? Attributes{} : Attributes{{"class", style}},
              element("caption", table.caption) + element("thead", element("tr", head)) + element("tbody", body));
  // Scrollable areas must be reachable by keyboard, and need a name for that.
  return element(
      "div", {{"class", "table"}},
      element("div", {{"class", "scroll"}, {"role", "region"}, {"tabindex", "0"}, {"aria-label", table.caption}},
              content) +
          menu);
}

Markup facts(const std::vector<std::pair<std::string, Markup>>& list) {
  Markup items;
  for (const auto& [name, value] : list) items += element("div", element("dt", name) + element("dd", value));
  return element("dl", {{"class", "facts"}}, items);
}

Markup details(const Markup& summary, const Markup& content, bool open) {
  return element("details", {{"open?", open ? "open" : ""}}, element("summary", summary) + content);
}

Markup picture(const std::string& type, const std::string& bytes, const std::string& alt) {
  // Synchronous decoding: a printer finds the picture as soon as the page is loaded.
  return element("img", {{"src", data_uri(type, bytes)}, {"alt", alt}, {"decoding", "sync"}});
}

Markup animation(const std::string& gif, const std::string& stills, const std::string& alt) {
  if (stills.empty()) return picture("image/gif", gif, alt);
  return element("div", {{"class", "on-screen"}}, picture("image/gif", gif, alt)) +
         element("div", {{"class", "on-paper"}}, picture("image/png", stills, alt));
}

Markup figure(const Markup& content, const Markup& caption) {
  return element("figure", content + (caption.empty() ? Markup() : element("figcaption", caption)));
}

Markup row(const std::vector<Markup>& pieces) { return element("div", {{"class", "row"}}, join(pieces)); }

namespace {

/// Returns a radio button of a group.
Markup choice(const std::string& group, const std::string& value, const Markup& label, bool chosen) {
  return element("label", element("input", {{"type", "radio"},
                                            {"name", group},
                                            {"value", value},
                                            {"autocomplete", "off"},
                                            {"checked?", chosen ? "checked" : ""}}) +
                              element("span", label));
}

Markup choices(const std::string& style, const std::string& legend, const Markup& options) {
  return element("fieldset", {{"class", "choices " + style}}, element("legend", legend) + options);
}

Markup view(const std::string& kind, const std::string& title, const std::string& bytes, const std::string& moment,
            Markup over = {}) {
  if (bytes.empty()) return {};
  return element("figure", {{"class", "view " + kind}},
                 element("div", {{"class", "frame"}}, picture("image/png", bytes, title + ", " + moment) + over) +
                     element("figcaption", title));
}

std::string percent(int place, int size) { return fmt::format("{:.3f}%", 100 * (place + 0.5) / size); }

/// @param index index of the moment in its viewer
Markup moment_panel(const ComparedPictures& m, std::size_t index, bool shown) {
  std::string style = fmt::format("--split: 50%; --width: {}; --height: {}", m.size[0], m.size[1]);
  Markup ring;  // the ring and other overlays
  if (m.worst) {
    style += fmt::format("; --x: {}; --y: {}", percent((*m.worst)[0], m.size[0]), percent((*m.worst)[1], m.size[1]));
    ring = element("span", {{"class", "ring"}, {"aria-hidden", "true"}});
  }
  for (const auto& [left, top, width, height] : m.ignored) {
    ring += element("span", {{"class", "ignored"},
                             {"style", fmt::format("left: {:.3f}%; top: {:.3f}%; width: {:.3f}%; height: {:.3f}%",
                                                   100. * left / m.size[0], 100. * top / m.size[1],
                                                   100. * width / m.size[0], 100. * height / m.size[1])},
                             {"aria-hidden", "true"}});
  }
  const Markup slider = element("input", {{"type", "range"},
                                          {"class", "split"},
                                          {"min", "0"},
                                          {"max", "100"},
                                          {"step", "0.5"},
                                          {"value", "50"},
                                          {"autocomplete", "off"},
                                          {"aria-label", "Left of the line expected, right of it actual"}});
  const bool pair = !m.expected.empty() && !m.actual.empty();
  const Markup stage = element(
      "div",
      {{"class", std::string("stage") + (pair ? " compared" : "") + (m.worst ? " aimed" : "")}, {"style", style}},
      view("expected", "Expected", m.expected, m.name, ring) + view("actual", "Actual", m.actual, m.name, ring) +
          view("difference", "Difference, brightened", m.difference, m.name, ring) +
          view("error-map", "FLIP error", m.error_map, m.name, ring) + (pair ? slider : Markup()));
  return element("div",
                 {{"class", "moment"}, {"data-moment", std::to_string(index)}, {"hidden?", shown ? "" : "hidden"}},
                 element("p", {{"class", "caption"}}, m.caption) + stage + m.action);
}

}  // namespace

Markup comparison(const std::string& id, const std::vector<ComparedPictures>& moments, std::size_t shown) {
  Markup names, panels;
  bool differs = false;
  for (std::size_t i = 0; i < moments.size(); ++i) {
    names += choice(id + "-moment", std::to_string(i), badge(moments[i].name, moments[i].tone), i == shown);
    panels += moment_panel(moments[i], i, i == shown);
    differs = differs || !moments[i].difference.empty();
  }
  Markup controls = choices("moments", "Frame", names);
  if (differs) {
    controls +=
        choices("views", "View",
                choice(id + "-view", "all", "Side by side", true) + choice(id + "-view", "slider", "Slider", false) +
                    choice(id + "-view", "blink", "Blink", false) +
                    choice(id + "-view", "difference", "Difference", false) +
                    choice(id + "-view", "error-map", "FLIP", false)) +
        element("label", {{"class", "magnify"}},
                element("input", {{"type", "checkbox"}, {"autocomplete", "off"}}) + " Magnify the worst pixel") +
        element("button", {{"type", "button"}, {"class", "pause"}}, "Pause");
  }
  if (differs) {
    panels += note(
        "Keys: 1 to 5 choose the view, comma and full stop the frame, the arrow keys move the slider, s swaps "
        "the blinking pictures.");
  }
  return element("div", {{"class", "comparison"}, {"id", id}, {"data-view", "all"}},
                 element("div", {{"class", "controls"}}, controls) + panels);
}

}  // namespace drape::html
