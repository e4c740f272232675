#include "html/film.hpp"

#include <fmt/format.h>

#include "html/components.hpp"

namespace drape::html {

Markup film(const std::string& id, const std::vector<std::string>& labels, const std::vector<FilmMoment>& moments) {
  Markup panels;
  for (std::size_t p = 0; p < labels.size(); ++p) {
    Markup pictures;
    for (std::size_t m = 0; m < moments.size(); ++m) {
      pictures += element(
          "div", {{"class", "shown-moment"}, {"data-moment", std::to_string(m)}, {"hidden?", m == 0 ? "" : "hidden"}},
          picture("image/png", moments[m].pictures.at(p), labels[p] + ", " + moments[m].name));
    }
    panels += element("figure", element("figcaption", labels[p]) + pictures);
  }
  Attributes slider{{"type", "range"},
                    {"min", "0"},
                    {"max", std::to_string(moments.size() - 1)},
                    {"step", "1"},
                    {"value", "0"},
                    {"autocomplete", "off"},
                    {"aria-label", "Moment"},
                    {"aria-valuetext", moments.front().name}};
  Markup names;
  for (const FilmMoment& moment : moments) names += element("li", moment.name);
  const Markup controls = element("button", {{"type", "button"}, {"class", "play"}}, "Play") +
                          element("input", slider) + element("output", {{"for", id}}, moments.front().name) +
                          element("ol", {{"class", "names"}, {"hidden?", "hidden"}}, names);
  return element(
      "div", {{"class", "film"}, {"id", id}},
      element("div", {{"class", "film-controls"}}, controls) + element("div", {{"class", "panels"}}, panels));
}

}  // namespace drape::html
