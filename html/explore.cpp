#include "html/explore.hpp"

#include <fmt/format.h>

#include "html/film.hpp"

namespace drape::html {

Markup strip(const Strip& strip) {
  const int rows = (strip.count + strip.columns - 1) / strip.columns;
  const auto [width, height] = strip.size;
  return element("div",
                 {{"class", "strip"},
                  {"data-columns", std::to_string(strip.columns)},
                  {"data-rows", std::to_string(rows)},
                  {"data-count", std::to_string(strip.count)},
                  {"data-poster", std::to_string(strip.poster)},
                  {"style", fmt::format("--columns: {}; aspect-ratio: {} / {}", strip.columns, width, height)}},
                 picture("image/png", strip.bytes, strip.alt));
}

Markup strips(const std::string& id, const std::vector<std::string>& moments, const Markup& content) {
  const Markup sheets =
      element("label", element("input", {{"type", "checkbox"}, {"class", "as-sheets"}, {"autocomplete", "off"}}) +
                           " Contact sheets");
  return element("div", {{"class", "strips"}, {"id", id}}, film_controls(id, moments, 0, sheets) + content);
}

Markup sortable_table(const Table& table) { return element("div", {{"class", "sortable"}}, html::table(table)); }

Markup choices(const std::string& id, const Choices& choices) {
  Markup lists, pieces;
  for (std::size_t l = 0; l < choices.lists.size(); ++l) {
    const auto& [label, names] = choices.lists[l];
    Markup options;
    for (std::size_t n = 0; n < names.size(); ++n) {
      const bool first = !choices.pieces.empty() && choices.pieces.front().chosen[l] == n;
      options += element("option", {{"value", std::to_string(n)}, {"selected?", first ? "selected" : ""}}, names[n]);
    }
    lists += element("label", Markup(label) + " " + element("select", {{"autocomplete", "off"}}, options));
  }
  for (const Choices::Piece& piece : choices.pieces) {
    std::string chosen;
    for (const std::size_t place : piece.chosen) chosen += fmt::format("{}{}", chosen.empty() ? "" : " ", place);
    pieces += element("div", {{"class", "choice"}, {"data-chosen", chosen}}, piece.content);
  }
  return element("div", {{"class", "chooser"}, {"id", id}}, element("p", {{"class", "choice-lists"}}, lists) + pieces);
}

}  // namespace drape::html
