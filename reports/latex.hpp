#pragma once

#include <string>
#include <string_view>

namespace drape::html {

/// Escapes a text for LaTeX, with any font.
std::string latex(std::string_view text);

/// Returns the replacements of latex() as a JavaScript object, for scripts that write LaTeX.
std::string latex_signs();

}  // namespace drape::html

namespace drape {

/// Escapes a text for Markdown, also for table cells: on one line, without special characters.
std::string markdown(std::string_view text);

/// Returns a text as inline code in Markdown, with any content.
std::string markdown_code(std::string_view text);

/// Encodes a file name as the target of a link (RFC 3986).
std::string link_to_file(std::string_view file);

}  // namespace drape
