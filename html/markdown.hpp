#pragma once

#include <string>
#include <string_view>

namespace drape {

/// Escapes a text for Markdown, also for table cells: on one line, without special characters.
std::string markdown(std::string_view text);

/// Returns a text as inline code in Markdown, with any content.
std::string markdown_code(std::string_view text);

/// Encodes a file name as the target of a link (RFC 3986).
std::string link_target(std::string_view file);

}  // namespace drape
