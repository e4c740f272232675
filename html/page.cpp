#include "html/page.hpp"

#include <fmt/format.h>

#include "core/build_info.hpp"
#include "core/machine.hpp"
#include "html/components.hpp"
#include "html/latex.hpp"
#include "html_assets.hpp"

namespace drape::html {
namespace {

// Blocks all network access of the page, whatever its content.
constexpr const char* policy =
    "default-src 'none'; img-src data:; style-src 'unsafe-inline'; script-src 'unsafe-inline'; form-action 'none'; "
    "base-uri 'none'";

Markup meta(const std::string& name, const std::string& content) {
  return element("meta", {{"name", name}, {"content", content}});
}

}  // namespace

std::string render(const Page& page) {
  const std::string style = fmt::format("{}{}{}{}{}{}{}{}{}{}", theme_css, diagram_css, page_css, chart_css, copies_css,
                                        comparison_css, film_css, explore_css, motion_player_css, print_css);
  const std::string script = fmt::format("{}{}{}{}{}{}const latexSigns = {};\n{}", page_js, film_js, explore_js,
                                         motion_data_js, motion_painter_js, motion_player_js, latex_signs(), copies_js);
  const Markup head = element("meta", {{"charset", "utf-8"}}) +
                      element("meta", {{"http-equiv", "Content-Security-Policy"}, {"content", policy}}) +
                      meta("viewport", "width=device-width, initial-scale=1") + meta("color-scheme", "light dark") +
                      meta("generator", "drape " + build_info().version) + element("title", page.title) +
                      element("link", {{"rel", "icon"}, {"href", "data:,"}}) + element("style", Markup::trusted(style));
  const Markup header =
      element("header", element("p", {{"class", "kind"}}, page.kind) + element("h1", page.heading) + page.introduction);
  const Markup footer = element("footer", element("h2", "How this was made") + facts(page.foot));
  const Markup body = header + element("main", page.content) + footer +
                      element("div", {{"id", "tip"}, {"role", "status"}, {"hidden?", "hidden"}}) +
                      element("script", Markup::trusted(script));
  return "<!doctype html>\n" + element("html", {{"lang", "en"}}, element("head", head) + element("body", body)).html() +
         "\n";
}

std::vector<std::pair<std::string, std::string>> provenance() {
  const BuildInfo& build = build_info();
  const MachineFacts machine = machine_facts();
  return {{"drape", fmt::format("{}, revision {}", build.version, build.revision)},
          {"Compiler", fmt::format("{}, {}", build.compiler, build.type)},
          {"Processor", fmt::format("{}, {} threads", machine.processor, machine.threads)},
          {"System", machine.system}};
}

}  // namespace drape::html
