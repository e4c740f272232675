#include "reports/page.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <utility>

#include "core/bytes.hpp"
#include "core/installation.hpp"
#include "core/machine.hpp"
#include "core/text.hpp"
#include "html_assets.hpp"
#include "reports/components.hpp"
#include "reports/latex.hpp"

namespace drape::html {
namespace {

constexpr std::array<std::string_view, 6> void_elements{"br", "hr", "img", "input", "link", "meta"};

}  // namespace

std::string escape(std::string_view text) {
  std::string escaped;
  escaped.reserve(text.size());
  for (const char c : printable(text)) {
    switch (c) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      case '\'':
        escaped += "&#39;";
        break;
      default:
        escaped += c;
    }
  }
  return escaped;
}

Markup::Markup(std::string_view text) : html_(escape(text)) {}

Markup Markup::trusted(std::string html) {
  Markup markup;
  markup.html_ = std::move(html);
  return markup;
}

Markup& Markup::operator+=(const Markup& other) {
  html_ += other.html_;
  return *this;
}

Markup element(std::string_view tag, const Attributes& attributes, const Markup& content) {
  std::string html("<");
  html += tag;
  for (const auto& [name, value] : attributes) {
    const bool optional = name.ends_with('?');
    if (optional && value.empty()) continue;
    html += ' ';
    html += optional ? name.substr(0, name.size() - 1) : name;
    if (optional) continue;
    html += "=\"";
    html += escape(value);
    html += '"';
  }
  html += '>';
  if (std::find(void_elements.begin(), void_elements.end(), tag) == void_elements.end()) {
    html += content.html();
    html += "</";
    html += tag;
    html += '>';
  }
  return Markup::trusted(std::move(html));
}

Markup join(const std::vector<Markup>& pieces) {
  Markup all;
  for (const Markup& piece : pieces) all += piece;
  return all;
}

std::string plain_text(const Markup& markup) {
  constexpr std::array<std::pair<std::string_view, char>, 5> entities{
      {{"&amp;", '&'}, {"&lt;", '<'}, {"&gt;", '>'}, {"&quot;", '"'}, {"&#39;", '\''}}};
  std::string text;
  std::string_view html = markup.html();
  while (!html.empty()) {
    if (html.front() == '<') {
      html.remove_prefix(std::min(html.find('>') + 1, html.size()));  // attributes contain no '>', see escape()
      continue;
    }
    const auto* const found =
        std::ranges::find_if(entities, [html](const auto& entity) { return html.starts_with(entity.first); });
    text += found == entities.end() ? html.front() : found->second;
    html.remove_prefix(found == entities.end() ? 1 : found->first.size());
  }
  return text;
}

std::string data_uri(std::string_view type, std::string_view bytes) {
  std::string uri("data:");
  uri += type;
  uri += ";base64,";
  uri += base64(bytes);
  return uri;
}

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
  const std::string style =
      fmt::format("{}{}{}{}{}{}{}{}{}{}{}", theme_css, diagram_css, page_css, chart_css, copies_css, comparison_css,
                  film_css, explore_css, listing_css, motion_player_css, print_css);
  const std::string script =
      fmt::format("{}{}{}{}{}{}{}const latexSigns = {};\n{}{}", page_js, film_js, explore_js, listing_js,
                  motion_data_js, motion_painter_js, motion_player_js, latex_signs(), latex_table_js, copies_js);
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
