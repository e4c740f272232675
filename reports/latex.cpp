#include "reports/latex.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cctype>
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

namespace drape {

std::string markdown(std::string_view text) {
  constexpr std::string_view signs = "\\`*_[]<>|&$~";
  const std::string shown = escape_controls(text);
  std::string escaped;
  for (std::size_t i = 0; i < shown.size(); ++i) {
    const char c = shown[i];
    // GitHub shows :name: as a picture.
    const bool picture =
        c == ':' && i + 1 < shown.size() && std::isgraph(static_cast<unsigned char>(shown[i + 1])) != 0;
    if (signs.find(c) != std::string_view::npos || picture) escaped += '\\';
    escaped += c == '\n' ? ' ' : c;
  }
  return escaped;
}

std::string markdown_code(std::string_view text) {
  const std::string code = shown(text);
  std::size_t longest = 0, run = 0;
  for (const char c : code) {
    run = c == '`' ? run + 1 : 0;
    longest = std::max(longest, run);
  }
  // The fence is longer than every run of backticks inside; the spaces belong to it (CommonMark, 6.1).
  const std::string fence(longest + 1, '`');
  return longest == 0 ? fence + code + fence : fence + " " + code + " " + fence;
}

std::string link_to_file(std::string_view file) {
  constexpr std::string_view unreserved = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-._~";
  std::string target;
  for (const char c : file) {
    if (unreserved.find(c) != std::string_view::npos) {
      target += c;
    } else {
      target += fmt::format("%{:02X}", static_cast<unsigned char>(c));
    }
  }
  return target;
}

}  // namespace drape
