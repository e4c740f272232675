#include "html/comparison.hpp"

#include <fmt/format.h>

namespace drape::html {
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
