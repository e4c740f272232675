#include "html/film.hpp"

#include "html/components.hpp"

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

}  // namespace drape::html
