#include "reports/players.hpp"

#include <fmt/format.h>

#include "core/bytes.hpp"
#include "reports/components.hpp"

namespace drape::html {

std::set<std::size_t> printed_moments(std::size_t count) {
  std::set<std::size_t> chosen;
  for (std::size_t i = 0; i < most_printed; ++i) chosen.insert(i * (count - 1) / (most_printed - 1));
  return chosen;
}

Markup film_controls(const std::string& id, const std::vector<std::string>& names, std::size_t first,
                     const Markup& more) {
  const Attributes slider{{"type", "range"},
                          {"min", "0"},
                          {"max", std::to_string(names.size() - 1)},
                          {"step", "1"},
                          {"value", std::to_string(first)},
                          {"autocomplete", "off"},
                          {"aria-label", "Moment"},
                          {"aria-valuetext", names.at(first)}};
  Markup list;
  for (const std::string& name : names) list += element("li", name);
  return element("div", {{"class", "film-controls"}},
                 element("button", {{"type", "button"}, {"class", "play"}}, "Play") + element("input", slider) +
                     element("output", {{"for", id}}, names.at(first)) + more +
                     element("ol", {{"class", "names"}, {"hidden?", "hidden"}}, list));
}

Markup film(const std::string& id, const std::vector<std::string>& labels, const std::vector<FilmMoment>& moments,
            std::size_t poster) {
  const std::set<std::size_t> chosen = printed_moments(moments.size());
  Markup panels;
  for (std::size_t p = 0; p < labels.size(); ++p) {
    Markup pictures;
    for (std::size_t m = 0; m < moments.size(); ++m) {
      pictures += element("div",
                          {{"class", chosen.contains(m) ? "shown-moment chosen" : "shown-moment"},
                           {"data-moment", std::to_string(m)},
                           {"hidden?", m == poster ? "" : "hidden"}},
                          picture("image/png", moments[m].pictures.at(p), labels[p] + ", " + moments[m].name) +
                              element("span", {{"class", "on-paper note"}}, moments[m].name));
    }
    panels += element("figure", element("figcaption", labels[p]) + element("div", {{"class", "pictures"}}, pictures));
  }
  std::vector<std::string> names;
  for (const FilmMoment& moment : moments) names.push_back(moment.name);
  return element("div", {{"class", "film"}, {"id", id}},
                 film_controls(id, names, poster) + element("div", {{"class", "panels"}}, panels));
}

namespace {

Markup box(const std::string& style, const std::string& label) {
  return element("label", element("input", {{"type", "checkbox"}, {"class", style}, {"autocomplete", "off"}}) +
                              Markup(" " + label));
}

Markup button(const std::string& style, const std::string& label) {
  return element("button", {{"type", "button"}, {"class", style}}, label);
}

Markup speeds(bool hidden) {
  Markup options;
  for (const auto& [factor, name] : {std::pair("0.1", "1/10"), std::pair("0.25", "1/4"), std::pair("0.5", "1/2"),
                                     std::pair("1", "1"), std::pair("2", "2")}) {
    options +=
        element("option", {{"value", factor}, {"selected?", std::string(factor) == "1" ? "selected" : ""}}, name);
  }
  return element("label", {{"hidden?", hidden ? "hidden" : ""}},
                 Markup("Speed ") + element("select", {{"class", "speed"}, {"autocomplete", "off"}}, options));
}

Markup controls(const std::string& id, const PlayedMotion& motion) {
  const Markup slider = element("input", {{"type", "range"},
                                          {"class", "moment-slider"},
                                          {"min", "0"},
                                          {"max", std::to_string(motion.frames - 1)},
                                          {"step", "1"},
                                          {"value", "0"},
                                          {"autocomplete", "off"},
                                          {"aria-label", "Moment"}});
  return element("div", {{"class", "film-controls"}, {"hidden?", motion.frames > 1 ? "" : "hidden"}},
                 button("play", "Play") + slider + element("output", {{"for", id}}, "t = 0 s")) +
         element("div", {{"class", "film-controls"}},
                 box("by-stretch", "Colour by stretch") + box("mesh-lines", "Mesh lines") + speeds(motion.frames == 1) +
                     button("reset", "Reset view"));
}

Markup data(const std::string& style, std::string text) {
  return element("script", {{"type", "text/plain"}, {"class", style}}, Markup::trusted(std::move(text)));
}

/// Escapes JSON so that it cannot end the enclosing element.
std::string harmless(std::string json) {
  for (std::size_t at = 0; (at = json.find('<', at)) != std::string::npos;) json.replace(at, 1, "\\u003c");
  return json;
}

}  // namespace

std::string describe(const PlayedMotion& motion) {
  return fmt::format(
      "{} frames of {} vertices and {} triangles in {:.0f} kB; coordinates are right to {:.2g} mm, 1/{:.0f} of the "
      "motion's size.",
      motion.frames, motion.vertices, motion.triangles, static_cast<double>(motion.data.size()) * 4 / 3 / 1000,
      1000 * motion.precision / 2, motion.size / (motion.precision / 2));
}

Markup motion_player(const std::string& id, const PlayedMotion& motion, const std::string& label) {
  const Markup canvas = element("canvas", {{"tabindex", "0"}, {"role", "img"}, {"aria-label", label}});
  const Markup texture = motion.texture.empty() ? Markup()
                                                : element("img", {{"class", "motion-texture"},
                                                                  {"src", data_uri("image/png", motion.texture)},
                                                                  {"alt", "The cloth's texture"},
                                                                  {"hidden?", "hidden"}});
  const Markup scale = element("div", {{"class", "stretch-scale"}, {"hidden?", "hidden"}}, Markup());
  return element(
      "div", {{"class", "turn"}, {"id", id}, {"data-frame", "0"}},
      canvas + element("p", {{"class", "turn-problem"}, {"role", "alert"}}) +
          element("noscript", element("p", "A script draws the motion; this browser runs none.")) +
          controls(id, motion) + scale +
          note(
              "Drag to turn; with Shift, or two fingers, to move; the wheel or two fingers enlarge. Keys: arrows turn, "
              "+ and − enlarge, 0 resets, the space bar plays, comma and full stop go by a frame, c colours, m shows "
              "the mesh.") +
          texture + data("motion-description", harmless(motion.description)) +
          data("motion-numbers", base64(motion.data)));
}

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
