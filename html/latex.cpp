#include "html/latex.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "core/text.hpp"

namespace drape::html {
namespace {

// LaTeX that pandoc understands as well; it drops unknown macros. µ, ° and ½ are letters of every LaTeX since 2020.
constexpr auto signs = std::to_array<std::pair<std::string_view, std::string_view>>({
    {"\\", "\\textbackslash{}"},
    {"~", "\\textasciitilde{}"},
    {"^", "\\textasciicircum{}"},
    {"&", "\\&"},
    {"%", "\\%"},
    {"$", "\\$"},
    {"#", "\\#"},
    {"_", "\\_"},
    {"{", "\\{"},
    {"}", "\\}"},
    {"--", "-{}-"},  // otherwise a dash
    {"[", "{[}"},    // otherwise an option after the end of a line
    {"]", "{]}"},
    {"*", "{*}"},
    {"<", "\\textless{}"},
    {">", "\\textgreater{}"},
    {"|", "$|$"},
    {"ε", "$\\varepsilon$"},
    {"λ", "$\\lambda$"},
    {"π", "$\\pi$"},
    {"τ", "$\\tau$"},
    {"Σ", "$\\Sigma$"},
    {"∇", "$\\nabla$"},
    {"‖", "$\\|$"},
    {"√", "$\\sqrt{}$"},
    {"∞", "$\\infty$"},
    {"→", "$\\to$"},
    {"×", "$\\times$"},
    {"·", "$\\cdot$"},
    {"≈", "$\\approx$"},
    {"≤", "$\\le$"},
    {"≥", "$\\ge$"},
    {"⁰", "\\textsuperscript{0}"},
    {"¹", "\\textsuperscript{1}"},
    {"²", "\\textsuperscript{2}"},
    {"³", "\\textsuperscript{3}"},
    {"⁴", "\\textsuperscript{4}"},
    {"⁵", "\\textsuperscript{5}"},
    {"⁶", "\\textsuperscript{6}"},
    {"⁷", "\\textsuperscript{7}"},
    {"⁸", "\\textsuperscript{8}"},
    {"⁹", "\\textsuperscript{9}"},
    {"⁻", "\\textsuperscript{$-$}"},
    {"−", "$-$"},
    {"–", "--"},
    {"…", "\\dots{}"},
    {"\n", " "},
});

/// Returns a JavaScript string literal.
std::string quoted(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '\n') {
      result += "\\n";
      continue;
    }
    if (c == '"' || c == '\\') result += '\\';
    result += c;
  }
  return result + "\"";
}

}  // namespace

std::string latex(std::string_view name) {
  const std::string whole = escape_controls(name);
  std::string_view text = whole;
  std::string result;
  while (!text.empty()) {
    const auto* const found =
        std::find_if(signs.begin(), signs.end(), [text](const auto& sign) { return text.starts_with(sign.first); });
    result += found == signs.end() ? text.substr(0, 1) : found->second;
    text.remove_prefix(found == signs.end() ? 1 : found->first.size());
  }
  return result;
}

std::string latex_signs() {
  std::string result;
  for (const auto& [sign, written] : signs) {
    result += fmt::format("{}{}: {}", result.empty() ? "{" : ", ", quoted(sign), quoted(written));
  }
  return result + "}";
}

}  // namespace drape::html
