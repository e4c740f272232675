#include "html/motion_player.hpp"

#include <fmt/format.h>

#include "core/text.hpp"
#include "html/components.hpp"

namespace drape::html {
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

}  // namespace drape::html
