#pragma once

#include <string>
#include <string_view>

namespace drape::html {

/// Escapes a text for LaTeX, with any font.
std::string latex(std::string_view text);

/// Returns the replacements of latex() as a JavaScript object, for scripts that write LaTeX.
std::string latex_signs();

}  // namespace drape::html
